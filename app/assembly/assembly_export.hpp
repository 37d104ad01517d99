#pragma once

#include "app/assembly/assembly_file.hpp"
#include "app/console/command_options.hpp"
#include "app/print/format/print_format.hpp"
#include "app/print/print_request.hpp"

namespace kinetix::app {

/// The design of bodies that an export is asked for, a file or the folder of a result; nothing for other designs.
std::optional<AssemblyFile> assembly_to_export(const PrintRequest& request);

/// What is written: its meshes as they are, at rest or turned as its drive says, and the way there.
PrintJob assembly_job(const AssemblyFile& file, const PrintRequest& request);

/// `export` of a design of bodies: stl, 3mf, glb and print.json, all of them or none. @return the exit code
/// @throws InvalidInput for other formats, for options that make sheets, and for a folded state that its drive does not come to
int export_assembly(const CommandOptions& options, const PrintRequest& request, const AssemblyFile& file);

}  // namespace kinetix::app
