#pragma once

#include "app/imports/model_parts.hpp"
#include "app/models/model_file.hpp"
#include "tests/fuzz/input_folder.hpp"

namespace kinetix::fuzz {

/// Checks that triangles have existing vertices.
inline void expect_whole(const targets::TriangleMesh& mesh) {
  for (const auto& triangle : mesh.triangles)
    for (const int v : triangle)
      if (v < 0 || v >= static_cast<int>(mesh.vertices.size())) fail("a triangle of no vertex");
}

/// Reads the shells of a file, hard and soft, as `import` does.
inline void read_as_model(const std::string& file) {
  read_or_refuse([&] {
    app::ImportRequest request;
    request.model = file;
    for (const model::ModelPart& part : app::read_model_parts(request).parts)
      if (part.name.empty()) fail("a part without a name");
  });
}

/// Reads the triangles of a file, as the other goals do. A helmet's use of them takes a hundred times as long:
/// readers/head.cpp tests it.
inline void read_as_mesh(const std::string& file) {
  read_or_refuse([&] { expect_whole(app::read_mesh_file(file).mesh); });
}

}  // namespace kinetix::fuzz
