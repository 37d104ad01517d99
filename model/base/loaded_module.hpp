#pragma once

#include <string>

namespace kinetix::model {

/// Returns a function of a module, a shared library of this program that is loaded at the first call and
/// stays loaded. Modules hold libraries that few runs need: loading them takes longer than finding a small
/// design. The loader searches the program's run path.
/// @param module file name, such as kinetix-cad.so
/// @param function name as in the module's header, extern "C"
/// @throws std::runtime_error if the module is missing or of another version
void* module_function(const std::string& module, const char* function);

/// Returns the path of a file that is installed next to the modules, for a program that is started as a
/// process.
/// @throws std::runtime_error if the file is missing
std::string module_file(const std::string& name);

}  // namespace kinetix::model
