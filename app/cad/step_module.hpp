#pragma once

#include <string>

#include "app/cad/assembly.hpp"

/// What kinetix-cad.so gives the program: see step_text.
extern "C" void kinetix_write_step(const kinetix::app::cad::Assembly& assembly, std::string& text);
