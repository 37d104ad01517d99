#include <fmt/format.h>
#include <iterator>

#include "app/cad/cad_formats.hpp"
#include "app/print/format/print_format.hpp"
#include "app/print/format/zip_text.hpp"

namespace kinetix::app {
namespace {

void add_tile(const PrintJob& job, int tile, std::vector<NamedContent>& files) {
  const TileParts parts = tile_parts(job, tile);
  const std::string name = "tile_" + std::to_string(tile + 1);
  files.push_back({name + ".stl", stl_text(job.sheet.name + " " + name, parts.hard)});
  if (!parts.soft.points.empty())
    files.push_back({name + "_soft.stl", stl_text(job.sheet.name + " " + name + " soft", parts.soft)});
}

std::vector<NamedContent> write_stl(const PrintJob& job) {
  const model::Polyhedron hard = hard_part(job), soft = soft_part(job);
  std::vector<NamedContent> files{{"hard.stl", stl_text(job.sheet.name + " hard", hard)}};
  files.push_back({"all.stl", stl_text(job.sheet.name, joined(hard, soft))});
  if (!soft.points.empty()) files.push_back({"soft.stl", stl_text(job.sheet.name + " soft", soft)});
  if (job.sheet.loose_rods() > 0)
    files.push_back({"rods.stl", stl_text(job.sheet.name + " rods", laid_out_rods(job.sheet))});
  if (job.sheet.tiles.count() > 1)
    for (int tile = 0; tile < job.sheet.tiles.count(); ++tile) add_tile(job, tile, files);
  return files;
}

}  // namespace

// Entry of the format stl: name, meaning and writer.
const PrintFormat stl_format = {
    .name = "stl", .meaning = "triangles for any slicer", .write = write_stl, .lies_on_bed = true};

namespace {

constexpr const char* content_types = R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
 <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
 <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
 <Default Extension="config" ContentType="text/xml"/>
</Types>
)";

constexpr const char* relationships = R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
 <Relationship Target="/3D/3dmodel.model" Id="rel-1" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
)";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '<'   ? "&lt;"
           : c == '>' ? "&gt;"
           : c == '&' ? "&amp;"
           : c == '"' ? "&quot;"
                      : std::string(1, c);
  return out;
}

/// Consecutive triangles of one material in the file's mesh.
struct Range {
  std::string name;
  int material;  // position in the file's list
  std::size_t first, count;
};

std::string model_xml(const std::string& name, const model::Polyhedron& all,
                      const std::vector<Range>& ranges) {
  std::string out = fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
 <metadata name="Title">{}</metadata>
 <metadata name="Application">kinetix</metadata>
 <resources>
  <basematerials id="1">
   <base name="hard" displaycolor="#D8D8D2FF"/>
   <base name="soft" displaycolor="#2E6FB7FF"/>
  </basematerials>
  <object id="2" type="model" name="{}" pid="1" pindex="0">
   <mesh>
    <vertices>
)",
                                escaped(name), escaped(name));
  const auto end = std::back_inserter(out);
  for (const Eigen::Vector3d& p : all.points) {
    const Eigen::Vector3f corner = p.cast<float>();  // exact: hard_part and soft_part have rounded it
    fmt::format_to(end, "<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n", corner.x(), corner.y(), corner.z());
  }
  out += "    </vertices>\n    <triangles>\n";
  for (const Range& range : ranges)
    for (std::size_t k = range.first; k < range.first + range.count; ++k) {
      const auto& [a, b, c] = all.triangles[k];
      fmt::format_to(end, "<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\" pid=\"1\" p1=\"{}\"/>\n", a, b, c,
                     range.material);
    }
  return out +
         "    </triangles>\n   </mesh>\n  </object>\n </resources>\n <build>\n  <item objectid=\"2\"/>\n "
         "</build>\n</model>\n";
}

using Gaps = std::optional<GapSettings>;

std::string gap_config(const GapSettings& gaps) {
  std::string out;
  for (const auto& [key, mm] : {std::pair{"slice_closing_radius", gaps.closing_radius_mm},
                                {"elefant_foot_compensation", gaps.elephant_foot_mm},
                                {"xy_size_compensation", gaps.expansion_mm}})
    out += fmt::format("  <metadata type=\"object\" key=\"{}\" value=\"{:.6g}\"/>\n", key, mm);
  return out;
}

/// Returns the settings for PrusaSlicer: the ranges as volumes, each with its extruder.
std::string slicer_config(const std::string& name, const std::vector<Range>& ranges, const Gaps& gaps) {
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<config>\n <object id=\"2\" instances_count=\"1\">\n"
      "  <metadata type=\"object\" key=\"name\" value=\"{}\"/>\n",
      escaped(name));
  if (gaps) out += gap_config(*gaps);
  for (const Range& range : ranges)
    out += fmt::format(
        "  <volume firstid=\"{}\" lastid=\"{}\">\n"
        "   <metadata type=\"volume\" key=\"name\" value=\"{}\"/>\n"
        "   <metadata type=\"volume\" key=\"volume_type\" value=\"ModelPart\"/>\n"
        "   <metadata type=\"volume\" key=\"extruder\" value=\"{}\"/>\n  </volume>\n",
        range.first, range.first + range.count - 1, range.name, range.material + 1);
  return out + " </object>\n</config>\n";
}

/// Settings that all files of one sheet share.
struct Making {
  Gaps gaps;
  bool one_material;  // soft parts come from the walls' extruder
};

NamedContent package(const std::string& name, const Making& making, model::Polyhedron all,
                     const model::Polyhedron& soft) {
  std::vector<Range> ranges{{"hard", 0, 0, all.triangles.size()}};
  if (making.one_material)
    ranges.front().count += soft.triangles.size();
  else if (!soft.triangles.empty())
    ranges.push_back({"soft", 1, all.triangles.size(), soft.triangles.size()});
  append(soft, all);
  return {name + ".3mf",
          zip_text({{"[Content_Types].xml", content_types},
                    {"_rels/.rels", relationships},
                    {"3D/3dmodel.model", model_xml(name, all, ranges)},
                    {"Metadata/Slic3r_PE_model.config", slicer_config(name, ranges, making.gaps)}})};
}

std::vector<NamedContent> write_threemf(const PrintJob& job) {
  const std::string& name = job.sheet.name;
  const Making making{gap_settings(job.sheet), job.sheet.is_one_material()};
  std::vector<NamedContent> files{package(name, making, hard_part(job), soft_part(job))};
  if (job.sheet.loose_rods() > 0)
    files.push_back(package(name + "_rods", making, laid_out_rods(job.sheet), {}));
  if (job.sheet.tiles.count() > 1)
    for (int tile = 0; tile < job.sheet.tiles.count(); ++tile) {
      TileParts parts = tile_parts(job, tile);
      files.push_back(
          package(name + "_tile_" + std::to_string(tile + 1), making, std::move(parts.hard), parts.soft));
    }
  return files;
}

}  // namespace

// Entry of the format 3mf: name, meaning and writer.
const PrintFormat threemf_format = {
    .name = "3mf", .meaning = "slicers, with both materials", .write = write_threemf, .lies_on_bed = true};

}  // namespace kinetix::app
