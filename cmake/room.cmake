# kinetix_room(name EXCEPT ... SOURCES ... HEADERS|PRECOMPILED_BY ... PUBLIC ... PRIVATE ...): one library
# target per folder, so that the link graph is the layering. It contains every .cpp of the folder except those
# that match the regex EXCEPT, and also the SOURCES. HEADERS are compiled once for all of them; PRECOMPILED_BY
# reuses those of another room.

add_library(kinetix_flags INTERFACE)
# A fused multiply-add would make results depend on the compiler's choice of instruction.
target_compile_options(kinetix_flags INTERFACE -ffp-contract=off)
# With it ccache can serve sources with a precompiled header.
target_compile_options(kinetix_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
# With OpenMP Eigen would split products, without it not, which gives one function two meanings. Threads run
# whole runs, in one place (model/base/parallel_runs.hpp).
target_compile_definitions(kinetix_flags INTERFACE EIGEN_DONT_PARALLELIZE)
# KiB: sources full of templates fill the compiler's heap several times over. Garbage collection only above
# one GiB saves a sixth of their time. The code is the same.
target_compile_options(kinetix_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1048576>)
# Headers that most sources of every room include.
set(kinetix_common_headers <Eigen/Core> <Eigen/Geometry> <Eigen/SparseCore> <algorithm> <array> <cmath> <functional>
  <map> <memory> <optional> <string> <variant> <vector>)
if(KINETIX_DEV)
  # Shadowing is checked for locals only. In joined sources, a local may have the name of another file's
  # constant.
  target_compile_options(kinetix_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow=local -Wconversion
    -Wno-sign-conversion -Wno-restrict -Wno-array-bounds -Wno-stringop-overread -Wno-stringop-overflow -Werror -UNDEBUG)
  # Twenty programs are linked, each in a third of the time. Some of those that mold 1.10 links do not start.
  find_program(LLD_PROGRAM ld.lld)
  if(LLD_PROGRAM)
    add_link_options(-fuse-ld=lld)
  endif()
else()
  # GCC 12 wrongly warns of each "text" + std::string: https://gcc.gnu.org/bugzilla/show_bug.cgi?id=105329
  target_compile_options(kinetix_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>)
endif()
if(KINETIX_FUZZ)
  # libFuzzer records the branches that an input takes. A sanitizer's finding ends the program, so that the
  # input is kept.
  target_compile_options(kinetix_flags INTERFACE -fsanitize=fuzzer-no-link -fno-sanitize-recover=all)
endif()
if(KINETIX_SANITIZE)
  # With the sanitizers' code in it, GCC 12 calls std::regex uninitialized. It also warns of every fence in
  # Boost's event loop, which the thread sanitizer does not see. Accesses that only a fence orders are in
  # cmake/tsan.supp.
  target_compile_options(kinetix_flags INTERFACE -fsanitize=${KINETIX_SANITIZE} -fno-omit-frame-pointer
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  if(KINETIX_SANITIZE STREQUAL "thread")
    target_compile_options(kinetix_flags INTERFACE -Wno-tsan)
  endif()
  target_link_options(kinetix_flags INTERFACE -fsanitize=${KINETIX_SANITIZE})
  # A fixed address halves the start time of a program of half a gigabyte. Soak tests start it thousands of
  # times.
  if(KINETIX_SANITIZE MATCHES address)
    target_link_options(kinetix_flags INTERFACE $<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:-no-pie>)
  endif()
  # Under the address sanitizer Eigen would pad its allocations. libceres, built without the sanitizer, shares
  # code with it, and each would free memory of the other.
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
  # Eigen aligns memory by the widest vectors that it sees. Memory of a program with wider vectors would not
  # suit the library or Debian's libceres. These flags limit Eigen to SSE; the compiler may still use all
  # vectors.
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

# kinetix_module(name OF room SOURCES ... LIBRARIES ...): sources of a room in a module that programs load on
# first use (model/base/loaded_module.hpp). It is for libraries that take longer to load than a small design
# takes to find. Programs find it by their run path (CMAKE_BUILD_RPATH; once installed, that of the room).
# Fuzzers cover the rooms only: a module does not find their counters.
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

# kinetix_reader(name OF room SOURCES ... LIBRARIES ...): a program kinetix-NAME next to the modules. It reads
# a foreign format with a library that damaged files crash (app/io/reader_program.hpp).
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

# kinetix_join(target EXCEPT ... TOGETHER ...): compiles the sources of each folder of a target (of two
# levels) as one. Most of their time goes into the same headers and templates. Sources that match the regex
# EXCEPT are compiled separately. Folders that match one of the regexes TOGETHER are one, with all folders
# below them. No two joined sources may therefore use one name for different local things.
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
