#pragma once

#include <string>

#include "app/cad/product.hpp"

// Interface of kinetix-cad.so: see app/cad/step.hpp.

extern "C" void kinetix_write_step(const kinetix::app::cad::Product& product, std::string& text);
