#pragma once

#include <string>

namespace kinetix::model {

/// A function of a module, a shared library of the program's own that is loaded at the first call and stays: libraries that
/// few runs need take longer to load than a small design takes to be found. Where it is looked for, the program's run path
/// says.
/// @param module file name, as kinetix-cad.so   @param function as the module's header declares it, extern "C"
/// @throws std::runtime_error where there is no such module or it is of another version
void* module_function(const std::string& module, const char* function);

}  // namespace kinetix::model
