# kinetix_room(name EXCEPT ... SOURCES ... HEADERS|PRECOMPILED_BY ... PUBLIC ... PRIVATE ...): one library target per folder, so that
# the link graph is the layering. It takes every .cpp of the folder but those that match the regex EXCEPT, and the
# SOURCES besides; HEADERS are compiled once for all of them, or are those that another room has: PRECOMPILED_BY.

add_library(kinetix_flags INTERFACE)
# A fused multiply-add would make results depend on the compiler's choice of instruction.
target_compile_options(kinetix_flags INTERFACE -ffp-contract=off)
# With it ccache can serve what was compiled with a precompiled header.
target_compile_options(kinetix_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
# Eigen would split products where OpenMP is on and not elsewhere: functions of one name and two meanings. Threads are
# for whole runs, in one place (model/base/parallel_runs.hpp).
target_compile_definitions(kinetix_flags INTERFACE EIGEN_DONT_PARALLELIZE)
# KiB: sources full of templates fill the compiler's heap several times over; to collect garbage only from a GiB on
# saves a sixth of their time. The code is the same.
target_compile_options(kinetix_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1048576>)
# What most sources of every room include.
set(kinetix_common_headers <Eigen/Core> <Eigen/Geometry> <Eigen/SparseCore> <algorithm> <array> <cmath> <functional>
  <map> <memory> <optional> <string> <variant> <vector>)
if(KINETIX_DEV)
  # Of locals alone: where sources are joined, a local may well be called as another file's constant is.
  target_compile_options(kinetix_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow=local -Wconversion
    -Wno-sign-conversion -Wno-restrict -Wno-array-bounds -Wno-stringop-overread -Wno-stringop-overflow -Werror -UNDEBUG)
else()
  # GCC 12 warns by itself of each "text" + std::string: https://gcc.gnu.org/bugzilla/show_bug.cgi?id=105329
  target_compile_options(kinetix_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>)
endif()
if(KINETIX_FUZZ)
  # libFuzzer follows which branches an input takes; what a sanitizer finds ends the program, so that the input is kept.
  target_compile_options(kinetix_flags INTERFACE -fsanitize=fuzzer-no-link -fno-sanitize-recover=all)
endif()
if(KINETIX_SANITIZE)
  # GCC 12 calls std::regex uninitialized once the sanitizers' code is in it, and warns of every fence in Boost's own
  # event loop, which the thread sanitizer does not see: what is only ordered by them is listed in cmake/tsan.supp.
  target_compile_options(kinetix_flags INTERFACE -fsanitize=${KINETIX_SANITIZE} -fno-omit-frame-pointer
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  if(KINETIX_SANITIZE STREQUAL "thread")
    target_compile_options(kinetix_flags INTERFACE -Wno-tsan)
  endif()
  target_link_options(kinetix_flags INTERFACE -fsanitize=${KINETIX_SANITIZE})
  # At one place in memory a program of half a gigabyte starts in half the time: soaks start it thousands of times.
  if(KINETIX_SANITIZE MATCHES address)
    target_link_options(kinetix_flags INTERFACE $<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:-no-pie>)
  endif()
  # Under the address sanitizer Eigen would pad what it allocates, and the code it shares with libceres, which
  # was built without, would free what the other allocated.
  target_compile_definitions(kinetix_flags INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()

function(kinetix_room name)
  cmake_parse_arguments(ROOM "" "EXCEPT;PRECOMPILED_BY" "SOURCES;HEADERS;PUBLIC;PRIVATE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(ROOM_EXCEPT)
    list(FILTER sources EXCLUDE REGEX ${ROOM_EXCEPT})
  endif()
  add_library(kinetix_${name} STATIC ${sources} ${ROOM_SOURCES})
  if(ROOM_PRECOMPILED_BY)
    target_precompile_headers(kinetix_${name} REUSE_FROM kinetix_${ROOM_PRECOMPILED_BY})
  else()
    target_precompile_headers(kinetix_${name} PRIVATE ${ROOM_HEADERS})
  endif()
  add_library(kinetix::${name} ALIAS kinetix_${name})
  set_target_properties(kinetix_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(kinetix_${name} PUBLIC cxx_std_20)
  # Eigen aligns memory by the widest vectors that it sees, so that memory of a program with wider ones cannot be given to the
  # library, nor to Debian's libceres. Eigen sees those of SSE; the compiler may still use all.
  target_compile_options(kinetix_${name} INTERFACE $<INSTALL_INTERFACE:-U__AVX__;-U__AVX2__;-U__AVX512F__;-U__FMA__>)
  target_include_directories(kinetix_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/kinetix>)
  if(KINETIX_SANITIZE)
    target_compile_definitions(kinetix_${name} PUBLIC EIGEN_MALLOC_ALREADY_ALIGNED=1)
  endif()
  target_link_libraries(kinetix_${name} PUBLIC ${ROOM_PUBLIC}
    PRIVATE $<BUILD_INTERFACE:kinetix_flags> ${ROOM_PRIVATE})
  install(TARGETS kinetix_${name} EXPORT kinetix-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/kinetix/${name}
    FILES_MATCHING PATTERN "*.hpp")
endfunction()

# kinetix_module(name OF room SOURCES ... LIBRARIES ...): sources of a room in a module that programs load when they meet what
# it is for (model/base/loaded_module.hpp): libraries that take longer to load than a small design takes to be found.
# Programs find it by their run path (CMAKE_BUILD_RPATH; once installed, that of the room). Fuzzers look into the rooms alone:
# a module does not find their counters.
function(kinetix_module name)
  cmake_parse_arguments(MODULE "" "OF" "SOURCES;LIBRARIES" ${ARGN})
  add_library(kinetix_${name} MODULE ${MODULE_SOURCES})
  set_target_properties(kinetix_${name} PROPERTIES PREFIX "" OUTPUT_NAME kinetix-${name} LIBRARY_OUTPUT_DIRECTORY ${KINETIX_MODULES})
  target_include_directories(kinetix_${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(kinetix_${name} PRIVATE Eigen3::Eigen ${MODULE_LIBRARIES})
  if(NOT KINETIX_FUZZ)
    target_link_libraries(kinetix_${name} PRIVATE kinetix_flags)
  endif()
  install(TARGETS kinetix_${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/kinetix/modules)
  add_dependencies(kinetix_${MODULE_OF} kinetix_${name})
  target_link_options(kinetix_${MODULE_OF} INTERFACE
    "$<INSTALL_INTERFACE:-Wl,-rpath,$<INSTALL_PREFIX>/${CMAKE_INSTALL_LIBDIR}/kinetix/modules>")
endfunction()

# kinetix_reader(name OF room SOURCES ... LIBRARIES ...): a program kinetix-NAME beside the modules, which reads a foreign format by a
# library that damaged files crash (app/io/reader_program.hpp).
function(kinetix_reader name)
  cmake_parse_arguments(READER "" "OF" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(kinetix-${name} ${READER_SOURCES})
  set_target_properties(kinetix-${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${KINETIX_MODULES} SKIP_BUILD_RPATH ON)
  target_include_directories(kinetix-${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(kinetix-${name} PRIVATE Eigen3::Eigen ${READER_LIBRARIES})
  if(NOT KINETIX_FUZZ)
    target_link_libraries(kinetix-${name} PRIVATE kinetix_flags)
  endif()
  install(TARGETS kinetix-${name} RUNTIME DESTINATION ${CMAKE_INSTALL_LIBDIR}/kinetix/modules)
  add_dependencies(kinetix_${READER_OF} kinetix-${name})
endfunction()

# kinetix_join(target EXCEPT ... TOGETHER ...): compiles the sources of each folder of a target (of two levels) as one, since
# most of their time goes into the same headers and templates: all but those that match the regex EXCEPT. Folders that match
# one of the regexes TOGETHER are one, with all below them. So no two sources that are joined may give the same name to
# things of their own.
function(kinetix_join target)
  cmake_parse_arguments(JOIN "" "EXCEPT" "TOGETHER" ${ARGN})
  get_target_property(sources ${target} SOURCES)
  if(JOIN_EXCEPT)
    list(FILTER sources EXCLUDE REGEX ${JOIN_EXCEPT})
  endif()
  foreach(source IN LISTS sources)
    get_filename_component(folder ${source} ABSOLUTE)
    get_filename_component(folder ${folder} DIRECTORY)
    file(RELATIVE_PATH folder ${CMAKE_CURRENT_SOURCE_DIR} ${folder})
    foreach(together IN LISTS JOIN_TOGETHER)
      string(REGEX REPLACE "^(${together})(/.*)?$" "${together}" folder "${folder}")
    endforeach()
    string(REGEX REPLACE "^([^/]*/[^/]*)/.*" "\\1" folder "${folder}")
    string(REGEX REPLACE "[^a-z_]" "_" group "of_${folder}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP "${group}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
