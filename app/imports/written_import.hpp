#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/console/command_options.hpp"
#include "app/files/design_file.hpp"
#include "app/imports/import_request.hpp"

namespace kinetix::app {

/// Of a design: its file's or folder's name, of letters, digits, `_`, `-` and `.`, at most 100.
std::string import_name(const ImportRequest& request);

/// design.yaml and its parts, all of them or none, and what was found on stdout: as JSON where that is asked for, else as text.
void write_import(const CommandOptions& options, const Design& design, const nlohmann::ordered_json& json,
                  const std::string& text);

}  // namespace kinetix::app
