#pragma once

#include <string>

namespace kinetix::model {

/// A function of a module, a shared library of the program's own that is loaded at the first call and stays: libraries that
/// few runs need take longer to load than a small design takes to be found. Where it is looked for, the program's run path
/// says.
/// @param module file name, as kinetix-cad.so   @param function as the module's header declares it, extern "C"
/// @throws std::runtime_error where there is no such module or it is of another version
void* module_function(const std::string& module, const char* function);

/// Path of a file that is installed beside the modules: a program that is started instead of loaded.
/// @throws std::runtime_error where there is no such file
std::string module_file(const std::string& name);

}  // namespace kinetix::model
