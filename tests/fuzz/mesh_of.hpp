#pragma once

#include "app/imports/model_parts.hpp"
#include "targets/mesh/mesh_file.hpp"
#include "tests/fuzz/input_folder.hpp"

namespace kinetix::fuzz {

/// Triangles of vertices that are there.
inline void expect_whole(const targets::TriangleMesh& mesh) {
  for (const auto& triangle : mesh.triangles)
    for (const int v : triangle)
      if (v < 0 || v >= static_cast<int>(mesh.vertices.size())) fail("a triangle of no vertex");
}

/// What `import` reads of a file: its shells, hard and soft.
inline void read_as_model(const std::string& file) {
  read_or_refuse([&] {
    app::ImportRequest request;
    request.model = file;
    for (const model::ModelPart& part : app::read_model_parts(request).parts)
      if (part.name.empty()) fail("a part without a name");
  });
}

/// What the other goals read of one: its triangles. What a helmet makes of them takes a hundred times as long: readers/head.cpp.
inline void read_as_mesh(const std::string& file) {
  read_or_refuse([&] { expect_whole(targets::read_mesh(file)); });
}

}  // namespace kinetix::fuzz
