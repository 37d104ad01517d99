# kinetix_room(name SOURCES ... PUBLIC ... PRIVATE ...): one library target per folder, so that the link
# graph is the layering.

add_library(kinetix_flags INTERFACE)
target_compile_features(kinetix_flags INTERFACE cxx_std_20)
# A fused multiply-add would make results depend on the compiler's choice of instruction.
target_compile_options(kinetix_flags INTERFACE -ffp-contract=off)
if(KINETIX_DEV)
  target_compile_options(kinetix_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
    -Wno-sign-conversion -Wno-restrict -Wno-stringop-overread -Werror -UNDEBUG)
endif()
if(KINETIX_SANITIZE)
  # GCC 12 calls std::regex uninitialized once the sanitizers' code is in it.
  target_compile_options(kinetix_flags INTERFACE -fsanitize=${KINETIX_SANITIZE} -fno-omit-frame-pointer
    -Wno-maybe-uninitialized)
  target_link_options(kinetix_flags INTERFACE -fsanitize=${KINETIX_SANITIZE})
endif()

function(kinetix_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(kinetix_${name} STATIC ${ROOM_SOURCES})
  add_library(kinetix::${name} ALIAS kinetix_${name})
  set_target_properties(kinetix_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(kinetix_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/kinetix>)
  # Under the address sanitizer Eigen would pad what it allocates, and the code it shares with libceres, which
  # was built without, would free what the other allocated.
  if(KINETIX_SANITIZE)
    target_compile_definitions(kinetix_${name} PUBLIC EIGEN_MALLOC_ALREADY_ALIGNED=1)
  endif()
  target_link_libraries(kinetix_${name} PUBLIC ${ROOM_PUBLIC}
    PRIVATE $<BUILD_INTERFACE:kinetix_flags> ${ROOM_PRIVATE})
  install(TARGETS kinetix_${name} EXPORT kinetix-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/kinetix/${name}
    FILES_MATCHING PATTERN "*.hpp")
endfunction()
