#include <fstream>
#include <iostream>
#include <sstream>

#include "app/formats/formats_page.hpp"
#include "model/base/invalid_input.hpp"

namespace {

std::string root;

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(root + file, std::ios::binary).rdbuf();
  return text.str();
}

void write(const std::string& file, const std::string& text) {
  std::ofstream(root + file, std::ios::binary) << text;
  std::cout << file << "\n";
}

std::string schema_file(const std::string& name) { return "app/schema/" + name + ".schema.json"; }

}  // namespace

/// Writes the pages of docs/reference about files, and the JSON Schemas of input files from the tables of their readers.
/// usage: kinetix-formats SOURCE_FOLDER
int main(int argc, char** argv) {
  try {
    root = std::string(argc > 1 ? argv[1] : ".") + "/";
    for (const auto& schema : kinetix::app::file_schemas()) write(schema_file(schema.name), schema.text);
    const auto text = [](const std::string& name) { return text_of(schema_file(name)); };
    for (const auto& page : kinetix::app::formats_pages(text_of("app/formats/page.in"), text))
      write("docs/reference/" + page.name, page.text);
  } catch (const kinetix::InvalidInput& e) {
    std::cerr << e.what() << "\n";
    return 1;
  }
}
