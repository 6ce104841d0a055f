# Install and packages: `cpack -G DEB` makes dressform (the program and the library scenes) and dressform-dev (headers,
# one archive of all objects, find_package(dressform)).
include(CMakePackageConfigHelpers)

set(scenes_folder ${CMAKE_INSTALL_DATADIR}/dressform/scenes)
install(TARGETS dressform RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY scenes/library/ DESTINATION ${scenes_folder} COMPONENT program)
install(DIRECTORY pipeline/presets/ DESTINATION ${CMAKE_INSTALL_DATADIR}/dressform/presets COMPONENT program)
install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

# The archive is linked whole by those who use it: variants register themselves and nobody names them.
get_property(folders GLOBAL PROPERTY DRESSFORM_FOLDERS)
set(objects "")
foreach(folder IN LISTS folders)
  list(APPEND objects $<TARGET_OBJECTS:${folder}>)
endforeach()
add_library(dressform_archive STATIC EXCLUDE_FROM_ALL ${objects})
set_target_properties(dressform_archive PROPERTIES OUTPUT_NAME dressform LINKER_LANGUAGE CXX)
install(TARGETS dressform_archive ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development OPTIONAL)
foreach(folder IN LISTS folders)
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dressform COMPONENT development
          FILES_MATCHING PATTERN "*.h" PATTERN testing EXCLUDE)
endforeach()
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/dressform)
configure_package_config_file(scripts/cmake/dressformConfig.cmake.in ${CMAKE_BINARY_DIR}/dressformConfig.cmake
                              INSTALL_DESTINATION ${config_folder}
                              PATH_VARS CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/dressformConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/dressformConfig.cmake ${CMAKE_BINARY_DIR}/dressformConfigVersion.cmake
        DESTINATION ${config_folder} COMPONENT development)

set(CPACK_PACKAGE_NAME dressform)
set(CPACK_PACKAGE_VENDOR "dressform")
set(CPACK_PACKAGE_CONTACT "dressform maintainers <maintainers@dressform.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Batch renderer and evaluation harness for clothes captured with Kinects")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME dressform)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME dressform-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# What find_package(dressform) looks for again: the -dev packages of the one list.
file(STRINGS scripts/packages.txt development REGEX "^(lib.*-dev|nlohmann-json3-dev|pkgconf)$")
list(JOIN development ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
include(CPack)
