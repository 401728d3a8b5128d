# Installs the build folder BUILD_DIR under a prefix of its own, and builds and runs two projects that use it.
set(prefix ${BUILD_DIR}/tests/house/installed)
file(REMOVE_RECURSE ${prefix})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${result}\n${output}")
  endif()
endfunction()

function(build_project name)
  set(folder ${BUILD_DIR}/tests/house/${name})
  file(REMOVE_RECURSE ${folder})
  run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/${name} -B ${folder} -G Ninja -DCMAKE_PREFIX_PATH=${prefix}
      -DCMAKE_CXX_FLAGS=${CXX_FLAGS})
  run(${CMAKE_COMMAND} --build ${folder})
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
run(${prefix}/bin/triptych --help)
foreach(file share/man/man1/triptych.1 share/bash-completion/completions/triptych share/zsh/site-functions/_triptych
             share/fish/vendor_completions.d/triptych.fish)
  file(READ ${prefix}/${file} text)
  if(NOT text MATCHES "pixel.*error")
    message(FATAL_ERROR "${file} does not tell the flags: ${text}")
  endif()
endforeach()
build_project(consumer)
run(${BUILD_DIR}/tests/house/consumer/consumer)

# Who embeds culling alone links nothing that only a build or a device needs.
build_project(embedder)
file(STRINGS ${BUILD_DIR}/tests/house/embedder/build.ninja link_line REGEX "LINK_LIBRARIES =")
if(NOT link_line MATCHES "triptych_visibility")
  message(FATAL_ERROR "no link line was found: ${link_line}")
endif()
string(TOLOWER "${link_line}" link_line)
foreach(library embree openmesh assimp draco libgl libegl osmesa glad glfw triptych_preprocess triptych_render)
  if(link_line MATCHES "${library}")
    message(FATAL_ERROR "a program that links triptych::visibility links ${library}: ${link_line}")
  endif()
endforeach()
run(${prefix}/bin/triptych sample isosurface -o ${BUILD_DIR}/tests/house/embedder/scene --triangles 20000)
run(${prefix}/bin/triptych build ${BUILD_DIR}/tests/house/embedder/scene/scene.ply
    -o ${BUILD_DIR}/tests/house/embedder/scene.tpk)
run(${BUILD_DIR}/tests/house/embedder/embedder ${BUILD_DIR}/tests/house/embedder/scene.tpk)
