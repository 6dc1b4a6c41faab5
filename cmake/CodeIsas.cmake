# The instruction sets that the library's own code is compiled for. Ray queries are Embree's, which chooses for itself.
#
# BDPT_CODE_ISAS  one of: native, default (what the compiler does by itself), or a list of baseline, avx2, avx512, of
#                 which the library takes the widest that the machine has when it is loaded (src/dispatch)
option(BDPT_NATIVE "Compile for the instruction set of this machine alone" OFF)

set(flags_native -march=native)
set(flags_default "")
set(flags_baseline -march=x86-64)
set(flags_avx2 -march=x86-64-v3)
set(flags_avx512 -march=x86-64-v4)

set(code_isas default)
if(CMAKE_SYSTEM_NAME STREQUAL Linux AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$" AND NOT BDPT_SANITIZE)
  set(code_isas baseline avx2 avx512)
endif()
set(BDPT_CODE_ISAS ${code_isas} CACHE STRING "Instruction sets of the library's own code")
if(BDPT_NATIVE)
  set(BDPT_CODE_ISAS native)  # not in the cache: without BDPT_NATIVE, what was asked for holds again
endif()
foreach(isa IN LISTS BDPT_CODE_ISAS)
  if(NOT DEFINED flags_${isa})
    message(FATAL_ERROR "BDPT_CODE_ISAS has ${isa}: give native, default, or a list of baseline, avx2 and avx512")
  endif()
endforeach()
list(LENGTH BDPT_CODE_ISAS count)
set(BDPT_DISPATCH OFF)
if(count GREATER 1)
  set(BDPT_DISPATCH ON)
endif()

# Tests and benchmarks look inside one of them: the widest that runs here.
list(GET BDPT_CODE_ISAS 0 BDPT_INNER_ISA)
if(BDPT_DISPATCH AND EXISTS /proc/cpuinfo)
  file(READ /proc/cpuinfo cpuinfo)
  foreach(isa IN LISTS BDPT_CODE_ISAS)
    if((isa STREQUAL avx2 AND cpuinfo MATCHES " avx2 ") OR (isa STREQUAL avx512 AND cpuinfo MATCHES " avx512vl "))
      set(BDPT_INNER_ISA ${isa})
    endif()
  endforeach()
endif()
