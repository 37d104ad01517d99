#pragma once

#include <string>

#include "app/cad/product.hpp"

// What kinetix-cad.so gives the program: see app/cad/step.hpp.

extern "C" void kinetix_write_step(const kinetix::app::cad::Product& product, std::string& text);
