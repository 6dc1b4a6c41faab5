# cmake --install and cpack: three components, library, development and tool.
include(CMakePackageConfigHelpers)
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/bdpt)

install(TARGETS bdpt EXPORT bdptTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/*)
install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(EXPORT bdptTargets NAMESPACE bdpt:: DESTINATION ${config_folder} COMPONENT development)

# Whoever links the shared library needs nothing else; the static one brings what it stands on.
set(includes "")
if(NOT BUILD_SHARED_LIBS)
  set(includes "set(BDPT_EMBREE_VERSION ${embree_VERSION})\ninclude(\${CMAKE_CURRENT_LIST_DIR}/Dependencies.cmake)\n")
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/Dependencies.cmake DESTINATION ${config_folder} COMPONENT development)
endif()
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/bdptConfig.cmake
  "${includes}include(\${CMAKE_CURRENT_LIST_DIR}/bdptTargets.cmake)\n")
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/bdptConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/bdptConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/bdptConfigVersion.cmake
  DESTINATION ${config_folder} COMPONENT development)

# The same for pkg-config. Its prefix is where it lies, so that the folder may be moved.
file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
set(pc_private "")
set(pc_cflags "")
if(NOT BUILD_SHARED_LIBS)
  set(pc_private "Requires.private: OpenEXR OpenColorIO Imath libpng tbb
Libs.private: -lembree${embree_VERSION_MAJOR} -lstdc++ -lm -ldl -pthread
")
  set(pc_cflags " -DBDPT_STATIC")
endif()
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/bdpt.pc "prefix=\${pcfiledir}/${up}
libdir=\${prefix}/${CMAKE_INSTALL_LIBDIR}
includedir=\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}

Name: bdpt
Description: ${PROJECT_DESCRIPTION}
Version: ${PROJECT_VERSION}
Libs: -L\${libdir} -lbdpt
Cflags: -I\${includedir}${pc_cflags}
${pc_private}")
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/bdpt.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

set(CPACK_PACKAGE_NAME bdpt)
set(CPACK_PACKAGE_CONTACT "The bdpt authors <bdpt@example.org>")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_GENERATOR TGZ DEB)
set(CPACK_PACKAGE_FILE_NAME bdpt-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_VERBATIM_VARIABLES ON)
# One archive, three Debian packages.
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/cpack.cmake "
if(CPACK_GENERATOR STREQUAL DEB)
  set(CPACK_DEB_COMPONENT_INSTALL ON)
endif()
")
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_BINARY_DIR}/cpack.cmake)
set(CPACK_COMPONENTS_ALL development)
if(BUILD_SHARED_LIBS)
  list(APPEND CPACK_COMPONENTS_ALL library)
endif()
if(BDPT_BUILD_TOOL)
  list(APPEND CPACK_COMPONENTS_ALL tool)
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libbdpt${abi})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libbdpt-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_TOOL_PACKAGE_NAME bdpt)
set(CPACK_DEBIAN_TOOL_PACKAGE_SECTION graphics)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "${PROJECT_DESCRIPTION}: the shared library")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${PROJECT_DESCRIPTION}: headers, and files for CMake and pkg-config")
set(CPACK_COMPONENT_TOOL_DESCRIPTION "${PROJECT_DESCRIPTION}: the program")
if(BUILD_SHARED_LIBS)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libbdpt${abi} (= ${PROJECT_VERSION})")
  set(CPACK_DEBIAN_TOOL_PACKAGE_DEPENDS "libbdpt${abi} (= ${PROJECT_VERSION})")
else()
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libembree-dev, libtbb-dev, libimath-dev, libopenexr-dev, libopencolorio-dev, libpng-dev")
endif()
include(CPack)
