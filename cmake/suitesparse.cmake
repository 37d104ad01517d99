# CHOLMOD and SPQR of SuiteSparse as SuiteSparse::cholmod and SuiteSparse::spqr: Debian ships no CMake config
# for them.
if(NOT TARGET SuiteSparse::cholmod)
  find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
  find_library(SPQR_LIBRARY spqr REQUIRED)
  find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
  add_library(SuiteSparse::cholmod INTERFACE IMPORTED)
  set_target_properties(SuiteSparse::cholmod PROPERTIES INTERFACE_LINK_LIBRARIES ${CHOLMOD_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${CHOLMOD_INCLUDE_DIR})
  add_library(SuiteSparse::spqr INTERFACE IMPORTED)
  set_target_properties(SuiteSparse::spqr PROPERTIES INTERFACE_LINK_LIBRARIES "${SPQR_LIBRARY};SuiteSparse::cholmod")
endif()
