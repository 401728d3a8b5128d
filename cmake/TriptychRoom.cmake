# triptych_room(NAME SOURCES file... [LINK library...] [PRIVATE_LINK library...] [PRECOMPILED kind] [SMALL_WORK])
# One folder, one library `triptych_NAME`; its public headers stand beside its sources.
add_library(triptych_warnings INTERFACE)
target_compile_options(triptych_warnings INTERFACE -Wall -Wextra -Wconversion -Wshadow)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")  # others compile for their sanitizers, and warn of other things
  target_compile_options(triptych_warnings INTERFACE -Werror)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # g++ 12 sees overlaps and writes out of bounds where a std::string is assigned a literal (its bugs 105651 and 105329).
  target_compile_options(triptych_warnings INTERFACE -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow
                                                   -Wno-stringop-overread)
endif()

function(triptych_room name)
  cmake_parse_arguments(ROOM "SMALL_WORK" "PRECOMPILED" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(triptych_${name} STATIC ${ROOM_SOURCES})
  add_library(triptych::${name} ALIAS triptych_${name})
  target_include_directories(triptych_${name} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/..>
                                                     $<INSTALL_INTERFACE:include/triptych>)
  # Bounds and cuts are computed without contracted arithmetic, so that runs can be compared.
  target_compile_options(triptych_${name} PRIVATE -ffp-contract=off)
  target_link_libraries(triptych_${name} PUBLIC ${ROOM_LINK} PRIVATE ${ROOM_PRIVATE_LINK}
                                         $<BUILD_INTERFACE:triptych_warnings>)
  set_target_properties(triptych_${name} PROPERTIES EXPORT_NAME ${name})
  if(ROOM_SMALL_WORK)  # behind large headers: compile time counts, not run time
    target_compile_options(triptych_${name} PRIVATE $<$<NOT:$<CONFIG:Debug>>:-O1>)
  endif()
  if(NOT ROOM_PRECOMPILED)
    set(ROOM_PRECOMPILED room)
  endif()
  triptych_use_precompiled(triptych_${name} ${ROOM_PRECOMPILED})
endfunction()
