# Installs the build into a scratch prefix and builds the examples against it, as an external project would. Then
# compares the numbers that they print with closed forms.
# STEP is one of
#   install   installs the library. The other steps need it.
#   together  builds all examples as one program.
#   wide      builds an example that crashes with another alignment, with the widest vectors of this machine.
#   each      builds each example by two compilers with vectors of any width: a long proof.
cmake_minimum_required(VERSION 3.22)
set(prefix ${SCRATCH}/prefix)
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE errors)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGV}\nended with ${code}\n${out}${errors}")
  endif()
  set(printed "${out}" PARENT_SCOPE)
endfunction()

# Checks the number in the parentheses of `regex` in a line of `printed`: it must be from `least` to `most`.
function(expect regex least most)
  if(NOT printed MATCHES "${regex}")
    message(FATAL_ERROR "no line matches \"${regex}\" in\n${printed}")
  endif()
  set(number ${CMAKE_MATCH_1})
  if(NOT (number GREATER_EQUAL least AND number LESS_EQUAL most))
    message(FATAL_ERROR "\"${regex}\": ${number} is not within ${least} to ${most} in\n${printed}")
  endif()
endfunction()

set(number "(-?[0-9.]+(e[-+][0-9]+)?)")

# Each function runs an example by its command line and compares its numbers.

# The strip has 20 cells of 11 mm over 188.5 mm of curve. It is shortened by about the cosine of the fold angle:
# acos(188.5 / 220) = 31 deg.
function(check_fit_curve)
  run(${ARGV})
  expect("off the half circle by ${number} mm" 0 0.2)
  expect("fold angle ${number} deg" 27 35)
endfunction()

# Closed form: theta = acos(0.9); 40 hinges turn by 2 theta; force = 0.4 theta / sin theta N, energy = 8 theta^2 N mm.
function(check_equilibrium_path)
  run(${ARGV})
  expect("closed form: force ${number} N" 0.413885 0.413895)
  expect("end of the path: force ${number} N" 0.4135 0.4142)
  expect("end of the path: force [0-9.]+ N, energy ${number} N mm" 1.6265 1.6285)
endfunction()

# cos(theta) = 0.9; tan(pi / 40) = tan(tilt) sin(theta).
function(check_custom_goal)
  run(${ARGV})
  expect("tilt ${number} deg" 10.233 10.235)
  expect("fold angle ${number} deg" 25.841 25.843)
  expect("folded: turns by ${number} deg" 179.9 180.1)
  expect("height ${number} of 10 mm" 8.999 9.001)
endfunction()

# The arch is a chain on a circle: psi = atan(tan(tilt) sin(theta)). Its chords of 10 cos(theta) cos(psi) mm turn by 2
# psi, and rise = radius (1 - cos(20 psi)).
# Quadrature over the two normal distributions gives a mean of 58.2157 mm and a variance of 0.33332 mm^2. First-order
# shares of the variance: 0.8510 (tilt) and 0.1443 (fold angle). Total shares: 0.8557 and 0.1490.
function(check_sweep)
  run(${ARGV})
  expect("of ${number} samples" 4096 4096)
  expect("rise ${number} mm" 58.205 58.225)
  expect("variance ${number} mm" 0.325 0.342)
  expect("tilt: ${number} of the variance" 0.82 0.88)
  expect("fold angle: ${number} of the variance" 0.12 0.17)
  expect("tilt: [0-9.]+ of the variance by itself, ${number} in all" 0.83 0.88)
  expect("fold angle: [0-9.]+ of the variance by itself, ${number} in all" 0.13 0.17)
endfunction()

function(check_physics_run)
  run(${ARGV})
  expect("physics run: settled after ${number} s" 0 60)
  expect("closed form: ${number} mm" 0 1e-4)
  expect("hinges open by ${number} mm" 0 1e-4)
endfunction()

set(all_examples fit_curve equilibrium_path custom_goal sweep physics_run)

# Builds a target of a project in `${SCRATCH}/name` with a compiler and with flags that a user may choose.
function(build source name compiler flags)
  run(${CMAKE_COMMAND} -S ${source} -B ${SCRATCH}/${name} -G Ninja -DCMAKE_PREFIX_PATH=${prefix}
      -DCMAKE_CXX_COMPILER=${compiler} -DCMAKE_CXX_FLAGS=${flags} -DCMAKE_EXE_LINKER_FLAGS=-s
      -DEXAMPLES=${SOURCE}/examples --no-warn-unused-cli)
  run(${CMAKE_COMMAND} --build ${SCRATCH}/${name} --target ${ARGN})
endfunction()

# Builds the examples after `flags`, or all of them, as a user would, and runs them.
function(build_and_run name compiler flags)
  set(examples ${ARGN})
  if(NOT examples)
    set(examples ${all_examples})
  endif()
  build(${SOURCE}/examples ${name} ${compiler} ${flags} ${examples})
  foreach(example ${examples})
    cmake_language(CALL check_${example} ${SCRATCH}/${name}/${example})
  endforeach()
endfunction()

if(STEP STREQUAL install)
  file(REMOVE_RECURSE ${SCRATCH})
  file(GLOB programs ${SOURCE}/examples/*.cpp)
  list(LENGTH programs count)
  list(LENGTH all_examples expected_count)
  if(NOT count EQUAL expected_count)
    message(FATAL_ERROR "${count} examples, and ${expected_count} with numbers to compare")
  endif()
  foreach(program ${programs})
    file(READ ${program} text)
    string(REGEX REPLACE "[^\n]" "" ends "${text}")
    string(LENGTH "${ends}" lines)
    if(lines GREATER 40)
      message(FATAL_ERROR "${program} has ${lines} lines; an example has at most 40")
    endif()
  endforeach()
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
  if(FLAGS)
    return()
  endif()
  # A program without the target's flags must not compile, since it would crash at run time.
  file(WRITE ${SCRATCH}/bare.cpp "#include <kinetix/kinetix.hpp>\nint main() {}\n")
  execute_process(COMMAND ${COMPILER} -std=c++20 -mavx2 -fsyntax-only -I${prefix}/include -I${prefix}/include/kinetix
                          -I/usr/include/eigen3 ${SCRATCH}/bare.cpp
                  RESULT_VARIABLE code ERROR_VARIABLE errors)
  if(code EQUAL 0 OR NOT errors MATCHES "Link the CMake target kinetix::kinetix")
    message(FATAL_ERROR "compiled without the target's flags, or without a sentence: ${errors}")
  endif()
  return()
endif()

# Wider vectors change Eigen's memory alignment, which is part of the library's binary interface.
find_program(CLANG NAMES clang++ clang++-14 REQUIRED)
if(STEP STREQUAL together)
  build(${CMAKE_CURRENT_LIST_DIR}/examples_together together ${COMPILER} "-O2 ${FLAGS}" examples)
  foreach(example ${all_examples})
    cmake_language(CALL check_${example} ${SCRATCH}/together/examples ${example})
  endforeach()
elseif(STEP STREQUAL wide)
  # Without the target's flags it crashes as fit_curve does, with either compiler. The other examples do not.
  build_and_run(wide ${CLANG} "-O2 -march=native" custom_goal)
elseif(STEP STREQUAL each)
  build_and_run(plain ${COMPILER} "-O2")
  foreach(flags -mavx2 -march=native)
    build_and_run(gcc${flags} ${COMPILER} "-O2 ${flags}")
    build_and_run(clang${flags} ${CLANG} "-O2 ${flags}")
  endforeach()
  build_and_run(clang ${CLANG} "-O2")
else()
  message(FATAL_ERROR "no step is named '${STEP}'")
endif()
