#include "app/print/format/zip_text.hpp"
#include "tests/fuzz/mesh_of.hpp"

using namespace kinetix;

/// Reads a 3MF package, or the XML of its model, as a model and as a mesh. Changes of a package would not reach the XML, since its checksums
/// would be wrong.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string given(reinterpret_cast<const char*>(data), size);
  const bool is_model = given.starts_with('<');
  const std::string package = is_model ? app::zip_text({{"3D/3dmodel.model", given}}) : given;
  const std::string path = fuzz::input_folder().write("input.3mf", package);
  fuzz::read_as_model(path);
  fuzz::read_as_mesh(path);
  return 0;
}
