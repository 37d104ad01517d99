#pragma once

#include <string>

#include "model/solids/polyhedron.hpp"

namespace kinetix::app {

/// A solid as binary STL, its coordinates rounded to float. @param name of the file's title
std::string stl_text(const std::string& name, const model::Polyhedron& solid);

}  // namespace kinetix::app
