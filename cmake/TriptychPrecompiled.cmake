# Headers of other libraries, compiled once for many targets. Sources include what they use all the same; the preset `debug` compiles them without. triptych_precompiled(KIND link...) makes one such set out of
# cmake/precompiled/KIND.hpp, triptych_use_precompiled(TARGET KIND) gives it to a target.
function(triptych_precompiled kind)
  set(folder ${PROJECT_SOURCE_DIR}/cmake/precompiled)
  add_library(triptych_precompiled_${kind} OBJECT ${folder}/nothing.cpp)
  target_link_libraries(triptych_precompiled_${kind} PRIVATE fmt::fmt glm::glm ${ARGN})
  target_compile_options(triptych_precompiled_${kind} PRIVATE -ffp-contract=off)
  target_precompile_headers(triptych_precompiled_${kind} PRIVATE ${folder}/${kind}.hpp)
endfunction()

function(triptych_use_precompiled target kind)
  target_precompile_headers(${target} REUSE_FROM triptych_precompiled_${kind})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fpch-preprocess)  # for ccache
  endif()
endfunction()
