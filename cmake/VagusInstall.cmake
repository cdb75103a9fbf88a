# `cmake --install`: the program, and what embeds plans in programs of others (find_package(Vagus)).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# In the order of the layers: each needs those before it.
set(VAGUS_INSTALLED_MODULES base keeper isa wire vm fastvm node hub plan fleet run toolbox aesl sim debug net session embed)

foreach(module IN LISTS VAGUS_INSTALLED_MODULES)
  # Toolboxes of others are shared libraries that link these.
  set_target_properties(vagus_${module} PROPERTIES EXPORT_NAME ${module} POSITION_INDEPENDENT_CODE ON)
  install(TARGETS vagus_${module} EXPORT VagusTargets
    COMPONENT embed
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${CMAKE_INSTALL_INCLUDEDIR}/vagus)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/src/${module}
    COMPONENT embed
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/vagus
    FILES_MATCHING PATTERN "*.hpp" PATTERN "*.def" PATTERN "*.inl"
    PATTERN "test_*" EXCLUDE)
endforeach()
install(DIRECTORY ${CMAKE_BINARY_DIR}/generated/templates ${CMAKE_BINARY_DIR}/generated/toolbox
  COMPONENT embed
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/vagus)
install(TARGETS vagus COMPONENT program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

# What the program reads at run time is in share/vagus, seen from its own folder, also where it is built: the
# examples, and the studio's pages once they are built.
# Examples as they are in the sources: without what trying them has left there.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/examples/ DESTINATION share/vagus/examples COMPONENT program
  PATTERN .vagus EXCLUDE PATTERN build EXCLUDE)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/web/dist/ DESTINATION share/vagus/pages COMPONENT program OPTIONAL)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/share/vagus)
file(CREATE_LINK ${CMAKE_SOURCE_DIR}/examples ${CMAKE_BINARY_DIR}/share/vagus/examples SYMBOLIC)
file(CREATE_LINK ${CMAKE_SOURCE_DIR}/web/dist ${CMAKE_BINARY_DIR}/share/vagus/pages SYMBOLIC)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/Vagus)
install(EXPORT VagusTargets NAMESPACE Vagus:: DESTINATION ${package} COMPONENT embed)
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/VagusConfig.cmake.in
  ${CMAKE_BINARY_DIR}/VagusConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/VagusConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/VagusConfig.cmake ${CMAKE_BINARY_DIR}/VagusConfigVersion.cmake
  DESTINATION ${package} COMPONENT embed)
