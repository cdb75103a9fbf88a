# `./dev package`: the Debian package, made by CPack from the component `program` of VagusInstall.cmake and what a
# system needs beside it: manual page, completion, the unit of a robot that starts by itself.
find_program(VAGUS_GZIP gzip REQUIRED)
set(manual ${CMAKE_BINARY_DIR}/share/man/man1/vagus.1.gz)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/share/man/man1)
add_custom_command(OUTPUT ${manual}
  COMMAND vagus page man > ${CMAKE_BINARY_DIR}/share/man/man1/vagus.1
  COMMAND ${VAGUS_GZIP} -9nf ${CMAKE_BINARY_DIR}/share/man/man1/vagus.1
  DEPENDS vagus VERBATIM)
add_custom_target(manual DEPENDS ${manual})

install(FILES ${manual} DESTINATION share/man/man1 COMPONENT program OPTIONAL)
install(FILES completions/vagus.bash RENAME vagus DESTINATION share/bash-completion/completions COMPONENT program)
install(FILES packaging/copyright README.md CHANGELOG.md SECURITY.md DESTINATION share/doc/vagus COMPONENT program)
# As in the sources, so that the links from one page to another lead somewhere.
install(DIRECTORY docs DESTINATION share/doc/vagus COMPONENT program)
install(FILES packaging/vagus.service DESTINATION lib/systemd/system COMPONENT program)
install(FILES packaging/vagus.sysusers RENAME vagus.conf DESTINATION lib/sysusers.d COMPONENT program)

# Packing builds nothing: tests and benchmarks are no part of the package.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_NAME vagus)
set(CPACK_PACKAGE_VENDOR "The Vagus authors")
set(CPACK_PACKAGE_CONTACT "The Vagus authors <maintainers@vagus.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "programming system for robots made of many microcontrollers")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
  "Vagus programs robots on two levels: event scripts on the microcontrollers, plans on the main computer.\n"
  "It compiles, simulates, runs and debugs both, on the command line and in the browser (vagus studio), and\n"
  "runs them on a robot from its boot on (vagus serve, vagus deploy).")
string(REPLACE ";" "" CPACK_DEBIAN_PROGRAM_DESCRIPTION "${CPACK_DEBIAN_PROGRAM_DESCRIPTION}")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME vagus)
set(CPACK_DEBIAN_PROGRAM_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION electronics)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "avahi-utils")
# Only suggested: its package starts a service. `vagus fleet serve` runs the program alone.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "mosquitto")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA
  ${CMAKE_SOURCE_DIR}/packaging/postinst ${CMAKE_SOURCE_DIR}/packaging/prerm ${CMAKE_SOURCE_DIR}/packaging/postrm)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
