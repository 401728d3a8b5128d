# cmake --install build/release --prefix DIR: the program, the rooms as libraries with their headers, and a CMake
# package: find_package(triptych) gives triptych::scene, triptych::lod and so on.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/triptych)
set(header_dir ${CMAKE_INSTALL_INCLUDEDIR}/triptych)

# launch/ is the program itself, not a library for others.
foreach(room base scene model simplify light preprocess cells lod visibility residency raster render protocol nodes measure report samples view session)
  target_compile_features(triptych_${room} INTERFACE cxx_std_20)
  install(TARGETS triptych_${room} EXPORT triptych ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${room} DESTINATION ${header_dir} FILES_MATCHING PATTERN *.hpp)
endforeach()

target_include_directories(glad SYSTEM PUBLIC $<INSTALL_INTERFACE:${header_dir}/loader>)
install(TARGETS glad EXPORT triptych ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/triptych)
install(DIRECTORY ${GLAD_DIR}/include/ DESTINATION ${header_dir}/loader)

install(TARGETS triptych triptych-import triptych-import-ifc triptych-import-step triptych-sample-kit RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
# The man page and what shells complete, from the descriptions that --help prints.
foreach(file "man;${CMAKE_INSTALL_MANDIR}/man1/triptych.1" "bash;${CMAKE_INSTALL_DATADIR}/bash-completion/completions/triptych"
             "zsh;${CMAKE_INSTALL_DATADIR}/zsh/site-functions/_triptych" "fish;${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d/triptych.fish")
  list(GET file 0 form)
  list(GET file 1 name)
  install(CODE "
    set(described \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${name}\")
    get_filename_component(folder \"\${described}\" DIRECTORY)
    file(MAKE_DIRECTORY \"\${folder}\")
    execute_process(COMMAND ${CMAKE_BINARY_DIR}/bin/triptych describe ${form} OUTPUT_FILE \"\${described}\" COMMAND_ERROR_IS_FATAL ANY)
    message(STATUS \"Installing: \${described}\")")
endforeach()
# The reader and the writer of IFC: our scripts, and of web-ifc what Node runs.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/launch/ifc/ DESTINATION ${CMAKE_INSTALL_DATADIR}/triptych/ifc
        FILES_MATCHING PATTERN *.mjs PATTERN package.json PATTERN package-lock.json PATTERN LICENSE.md
        PATTERN web-ifc-api-node.js PATTERN web-ifc-node.wasm)
install(EXPORT triptych NAMESPACE triptych:: FILE triptych-targets.cmake DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/triptych-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_SOURCE_DIR}/cmake/triptych-config.cmake ${CMAKE_BINARY_DIR}/triptych-config-version.cmake
        DESTINATION ${package_dir})
