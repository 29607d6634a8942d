# What `cmake --install` copies and `make package` packs: the program, which finds its studies beside itself.
include(GNUInstallDirs)

install(TARGETS mpm-verify RUNTIME)
install(DIRECTORY verification/studies verification/scenes verification/adapters verification/templates
        DESTINATION ${CMAKE_INSTALL_DATADIR}/mpm-verify USE_SOURCE_PERMISSIONS)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs)
install(FILES README.md CONTRIBUTING.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(FILES reports/pictures/poiseuille-profiles.png DESTINATION ${CMAKE_INSTALL_DOCDIR}/reports/pictures)
install(FILES packaging/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME mpm-verify)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The mpm-verify authors <mpm-verify@example.org>")
set(CPACK_PACKAGE_VENDOR "mpm-verify")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS gnuplot-nox)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS chromium)
# The libraries that the program needs, by asking it; dpkg-dev has the tool.
find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
if(DPKG_SHLIBDEPS)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
endif()
include(CPack)
