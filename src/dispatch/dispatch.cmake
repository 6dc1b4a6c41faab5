# The library from its objects: one file for each instruction set, in which nothing is to be seen but the functions of
# bdpt.h, and with several of them the code that chooses.
#
# A file is linked in advance (ld -r) and its other names are made local (objcopy), for two reasons: templates and inline
# functions of the sets must not be merged, and a program that links libbdpt.a must not meet names from inside of it.

file(STRINGS ${PROJECT_SOURCE_DIR}/include/bdpt.h lines REGEX "^BDPT_API")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/bdpt.h)
set(functions "")
foreach(line IN LISTS lines)
  string(REGEX MATCH "(bdpt_[a-z0-9_]+)\\(" found "${line}")
  list(APPEND functions ${CMAKE_MATCH_1})
endforeach()
list(LENGTH functions count)

# bdpt_link_objects(<isa> <suffix>): sets linked_<isa> to a file; its functions are named with the suffix.
function(bdpt_link_objects isa suffix)
  set(base ${CMAKE_CURRENT_BINARY_DIR}/${isa})
  set(kept "")
  set(renamed "")
  foreach(f IN LISTS functions)
    string(APPEND kept "${f}${suffix}\n")
    string(APPEND renamed "${f} ${f}${suffix}\n")
  endforeach()
  file(WRITE ${base}.kept "${kept}")
  set(options --keep-global-symbols=${base}.kept)
  if(suffix)
    file(WRITE ${base}.renamed "${renamed}")
    list(APPEND options --redefine-syms=${base}.renamed --rename-section .init_array=bdpt_init${suffix})
  endif()
  set(objects $<FILTER:$<TARGET_OBJECTS:bdpt_objects_${isa}>,EXCLUDE,\.gch$>)
  file(GENERATE OUTPUT ${base}.objects CONTENT "$<JOIN:${objects},\n>\n")
  add_custom_command(OUTPUT ${base}.o
    COMMAND ${CMAKE_LINKER} -r --force-group-allocation -o ${base}_open.o @${base}.objects
    COMMAND ${CMAKE_OBJCOPY} ${options} ${base}_open.o ${base}.o
    DEPENDS bdpt_objects_${isa} ${objects} ${base}.objects
    COMMENT "Linking bdpt's objects for ${isa}" VERBATIM)
  set(linked_${isa} ${base}.o PARENT_SCOPE)
endfunction()

set(files "")
if(BDPT_DISPATCH)
  set(trampolines "")
  set(index 0)
  foreach(f IN LISTS functions)
    string(APPEND trampolines "__asm__(\".text\\n.p2align 4\\n.globl ${f}\\n.type ${f}, @function\\n${f}:\\n\""
      "\"endbr64\\njmp *bdpt_calls+8*${index}(%rip)\\n.size ${f}, .-${f}\\n\");\n")
    math(EXPR index "${index} + 1")
  endforeach()
  set(variants "")
  set(table "")
  foreach(isa IN LISTS BDPT_CODE_ISAS)
    bdpt_link_objects(${isa} __${isa})
    list(APPEND files ${linked_${isa}})
    string(APPEND variants "HIDDEN extern const call __start_bdpt_init__${isa}[], __stop_bdpt_init__${isa}[];\n")
    set(calls "")
    foreach(f IN LISTS functions)
      string(APPEND variants "HIDDEN void ${f}__${isa}(void);\n")
      string(APPEND calls "    ${f}__${isa},\n")
    endforeach()
    string(APPEND variants "static const call calls_${isa}[kCalls] = {\n${calls}};\n")
    set(is_there has_${isa})
    if(isa STREQUAL baseline)
      set(is_there is_always)
    endif()
    string(APPEND table "    {\"${isa}\", ${is_there}, calls_${isa}, __start_bdpt_init__${isa}, __stop_bdpt_init__${isa}},\n")
  endforeach()
  configure_file(${CMAKE_CURRENT_LIST_DIR}/dispatch.c.in ${CMAKE_CURRENT_BINARY_DIR}/dispatch.c @ONLY)
  list(APPEND files ${CMAKE_CURRENT_BINARY_DIR}/dispatch.c)
else()
  bdpt_link_objects(${BDPT_CODE_ISAS} "")
  list(APPEND files ${linked_${BDPT_CODE_ISAS}})
endif()
set(BDPT_LINKED_FILES ${files})
