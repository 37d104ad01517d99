#pragma once

#include <string>

#include "targets/mesh/triangle_mesh.hpp"

// Interface of kinetix-mesh.so to the program: see targets/mesh/mesh_file.hpp.

/// @param mesh to which triangles are added   @param refusal becomes why assimp refuses the file, if it does
extern "C" void kinetix_assimp_mesh(const std::string& bytes, const std::string& format,
                                    kinetix::targets::TriangleMesh& mesh, std::string& refusal);
