#include "app/imports/import_request.hpp"

#include <fmt/format.h>
#include <cctype>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/files/bodies_section.hpp"
#include "app/io/atomic_file.hpp"

namespace kinetix::app {

std::string import_name(const ImportRequest& request) {
  std::filesystem::path path(request.model.empty() ? request.hard : request.model);
  if (!path.has_filename()) path = path.parent_path();
  std::string stem = path.stem().string().substr(0, 100);
  for (char& c : stem)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-' && c != '.') c = '_';
  return stem.empty() || stem[0] == '.' ? "_" + stem : stem;
}

void write_import(const CommandOptions& options, const Design& design, const nlohmann::ordered_json& json,
                  const std::string& text) {
  OutputFolder folder(options.folder_of(design.name));
  FileSet files(folder.path());
  for (const NamedContent& content : design_files(design)) files.add(content.name, content.content);
  files.commit();
  folder.keep();
  if (options.json)
    std::cout << json.dump(1) << "\n";
  else
    std::cout << text << fmt::format("  {:<10} {}/design.yaml, parts\n", "written", folder.path());
}

}  // namespace kinetix::app
