#pragma once

#include <string>

#include "model/solids/polyhedron.hpp"

namespace kinetix::app {

/// Returns a solid as binary STL, with coordinates rounded to float. @param name title in the header
std::string stl_text(const std::string& name, const model::Polyhedron& solid);

}  // namespace kinetix::app
