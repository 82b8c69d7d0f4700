# `cpack` in the build folder makes the Debian package of what `cmake --install` installs.
find_program(GZIP gzip REQUIRED)
set(copyright ${documents}/copyright)
configure_file(${CMAKE_CURRENT_LIST_DIR}/copyright ${copyright} COPYONLY)
configure_file(${CMAKE_CURRENT_LIST_DIR}/changelog ${documents}/changelog)
# Debian wants both compressed, without the time of the build.
add_custom_command(OUTPUT ${documents}/changelog.gz ${documents}/crackle.1.gz
    COMMAND ${GZIP} -9nkf ${documents}/changelog ${documents}/crackle.1
    DEPENDS ${documents}/crackle.1 ${documents}/changelog COMMENT "Changelog and manual page compressed" VERBATIM)
add_custom_target(crackle_compressed ALL DEPENDS ${documents}/changelog.gz)
install(FILES ${documents}/crackle.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${copyright} ${documents}/changelog.gz DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME crackle)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "Crackle maintainers <crackle@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "bonded rock specimens, made and tested virtually")
set(CPACK_PACKAGE_DESCRIPTION "Crackle packs circles, makes Delaunay triangles or Voronoi polygons of them,
bonds them and loads them between platens until they break: two-dimensional
discrete elements for rock mechanics. It writes stress-strain curves, every
bond break, frames for ParaView, figures and an interactive report.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS fonts-dejavu-core)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "gnuplot-nox, paraview")
include(CPack)
