#pragma once

#include <string>
#include <vector>

#include "app/cad/found_solid.hpp"
#include "app/cad/product.hpp"

// What kinetix-cad.so gives the program: see app/cad/step.hpp.

extern "C" void kinetix_write_step(const kinetix::app::cad::Product& product, std::string& text);

/// @throws std::runtime_error where it cannot be read
extern "C" void kinetix_read_step(const std::string& file,
                                  std::vector<kinetix::app::cad::FoundSolid>& solids);
