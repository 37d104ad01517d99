# `make package`: kinetix_VERSION_ARCH.deb with program, library, documentation, manual, completion and, if it
# was built, the Python module. dpkg-shlibdeps finds the shared libraries that it needs.
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
# The site, if `make site` has built it.
install(DIRECTORY build/site/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/html OPTIONAL)
install(DIRECTORY docs examples DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN "__pycache__" EXCLUDE)
install(DIRECTORY targets/shapes targets/sweeps DESTINATION ${CMAKE_INSTALL_DATADIR}/kinetix/targets
  PATTERN "__pycache__" EXCLUDE PATTERN "*.py" EXCLUDE)

# Headers and libraries to link other programs with; the fonts are for letters of displays.
file(STRINGS packages/program.txt for_programs REGEX "-dev$")
list(JOIN for_programs ", " for_programs)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME kinetix)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The kinetix project")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "designs flat sheets of walls and hinges that fold into a goal shape")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS fonts-dejavu-core)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "${for_programs}, prusa-slicer")
if(KINETIX_PYTHON)
  math(EXPR after "${Python_VERSION_MINOR} + 1")
  string(APPEND CPACK_DEBIAN_PACKAGE_DEPENDS
    ", python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${after}), python3-numpy")
endif()
include(CPack)
