# `cpack` in the build folder makes Debian packages of the files that `cmake --install` installs.
find_program(GZIP gzip REQUIRED)
set(copyright ${documents}/copyright)
configure_file(${CMAKE_CURRENT_LIST_DIR}/copyright ${copyright} COPYONLY)
set(changes ${PROJECT_SOURCE_DIR}/CHANGELOG.md)
add_custom_command(OUTPUT ${documents}/changelog
    COMMAND ${CMAKE_CURRENT_LIST_DIR}/debian_changelog ${changes} > ${documents}/changelog
    DEPENDS ${CMAKE_CURRENT_LIST_DIR}/debian_changelog ${changes} COMMENT "Converting the changelog to Debian's format" VERBATIM)
# Debian requires that both files are compressed, without timestamps.
add_custom_command(OUTPUT ${documents}/changelog.gz ${documents}/crackle.1.gz
    COMMAND ${GZIP} -9nkf ${documents}/changelog ${documents}/crackle.1
    DEPENDS ${documents}/crackle.1 ${documents}/changelog COMMENT "Compressing the changelog and the manual page" VERBATIM)
add_custom_target(crackle_compressed ALL DEPENDS ${documents}/changelog.gz)
install(FILES ${documents}/crackle.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${copyright} ${documents}/changelog.gz DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES ${copyright} ${documents}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libcrackle-dev COMPONENT development)
install(FILES ${copyright} ${documents}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/crackle-bench COMPONENT bench)
if(TARGET crackle_python)
  install(FILES ${copyright} ${documents}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-crackle COMPONENT python)
endif()

set(CPACK_GENERATOR DEB)
# The packages are crackle, crackle-bench, python3-crackle, and libcrackle-dev, which serves find_package(crackle).
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL program development bench)
if(TARGET crackle_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME crackle)
set(CPACK_DEBIAN_BENCH_PACKAGE_NAME crackle-bench)
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-crackle)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libcrackle-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_PACKAGE_NAME crackle)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "Crackle maintainers <crackle@example.org>")
# The first line of each description is its summary.
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "bonded rock specimens, made and tested virtually
Crackle packs circles, turns them into Delaunay triangles or Voronoi polygons,
bonds them and loads them between platens until they break: two-dimensional
discrete elements for rock mechanics. It writes stress-strain curves, every
bond break, frames for ParaView, figures and an interactive report.")
set(CPACK_DEBIAN_BENCH_DESCRIPTION "studies of the engine of crackle
Comparisons with closed forms and physical laws, run time against error,
scenes that test numerical stability, particle-steps per second against the
limits of the machine, and the rock of DEMseg's guide on many packings.")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "bonded rock specimens, made and tested from Python
The commands of crackle as functions, with the same options and results:
specimens, tests with callbacks, worlds that are stepped and loaded from
Python, and the engine's arrays as numpy arrays, without copies.")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "bonded rock specimens, libraries to link
Static libraries and headers of crackle, found by find_package(crackle) in
CMake: the solver, the mesher, and the virtual tests built on them.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS fonts-dejavu-core)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "crackle-bench, paraview, python3-crackle")
# The package crackle contains the shipped cases, which crackle-bench uses.
set(CPACK_DEBIAN_BENCH_PACKAGE_DEPENDS "crackle (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_BENCH_PACKAGE_SUGGESTS gnuplot-nox)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "crackle (= ${PROJECT_VERSION}), python3 (>= 3.11), python3 (<< 3.12), python3-numpy, fonts-dejavu-core")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-matplotlib")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libfmt-dev, nlohmann-json3-dev, libcereal-dev, libssl-dev, libpugixml-dev, libsqlite3-dev, libsqlitecpp-dev, libnlopt-cxx-dev, libtomlplusplus-dev, zlib1g-dev, libcairo2-dev, libisal-dev, libxxhash-dev, libmpfr-dev, libgmp-dev, libeigen3-dev, pkg-config")
if(NOT crackle_sets STREQUAL known_sets)
  set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/needs_all_sets.cmake)
endif()
include(CPack)
