#include <fmt/format.h>
#include <algorithm>
#include <iterator>

#include "app/print/format/print_format.hpp"
#include "app/print/format/sheet_drawing.hpp"
#include "app/print/format/zip_text.hpp"

namespace kinetix::app {
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

/// Consecutive triangles of one material in a mesh.
struct Range {
  std::string name;
  int material;  // position in the file's list
  std::size_t first, count;
};

/// A mesh in the file, as an object with its own number.
struct MeshObject {
  int id;
  std::string name;
  model::Polyhedron mesh;
  std::vector<Range> ranges;
};

/// Content of one 3MF file. Several meshes are components of one more object, which is then the last.
struct Content {
  std::string name;
  std::vector<MeshObject> meshes;

  int built_id() const { return meshes.back().id + (meshes.size() > 1 ? 1 : 0); }
};

constexpr const char* cura_space = "http://software.ultimaker.com/xml/cura/3mf/2015/10";

/// Returns the settings for Cura, which reads them on each mesh. Its extruders count from 0.
std::string cura_metadata(const SlicerSettings& settings, std::optional<int> extruder) {
  std::string out = "   <metadatagroup>\n";
  const auto add = [&](const std::string& key, const std::string& value) {
    out += fmt::format("    <metadata name=\"cura:{}\" type=\"xs:string\" preserve=\"1\">{}</metadata>\n",
                       key, value);
  };
  if (extruder) add("extruder_nr", std::to_string(*extruder));
  for (const auto& [key, value] : settings) add(key, value);
  return out + "   </metadatagroup>\n";
}

std::string object_xml(const MeshObject& object, const std::string& metadata) {
  std::string out = fmt::format(
      "  <object id=\"{}\" type=\"model\" name=\"{}\" pid=\"1\" pindex=\"{}\">\n{}   <mesh>\n"
      "    <vertices>\n",
      object.id, escape_marks(object.name), object.ranges.front().material, metadata);
  const auto end = std::back_inserter(out);
  for (const Eigen::Vector3d& p : object.mesh.points) {
    const Eigen::Vector3f corner = p.cast<float>();  // exact: hard_part and soft_part have rounded it
    fmt::format_to(end, "<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n", corner.x(), corner.y(), corner.z());
  }
  out += "    </vertices>\n    <triangles>\n";
  for (const Range& range : object.ranges)
    for (std::size_t k = range.first; k < range.first + range.count; ++k) {
      const auto& [a, b, c] = object.mesh.triangles[k];
      fmt::format_to(end, "<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\" pid=\"1\" p1=\"{}\"/>\n", a, b, c,
                     range.material);
    }
  return out + "    </triangles>\n   </mesh>\n  </object>\n";
}

/// Returns the object that joins the meshes.
std::string joining_object_xml(const Content& content) {
  std::string out = fmt::format("  <object id=\"{}\" type=\"model\" name=\"{}\">\n   <components>\n",
                                content.built_id(), escape_marks(content.name));
  for (const MeshObject& object : content.meshes)
    out += fmt::format("    <component objectid=\"{}\"/>\n", object.id);
  return out + "   </components>\n  </object>\n";
}

/// Returns the model. No name of a program may be in it: Orca and Bambu take a file with one for another program's.
/// @param cura settings for Cura; empty: none
std::string model_xml(const Content& content, const std::optional<SlicerSettings>& cura) {
  std::string out =
      fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"{}>
 <metadata name="Title">{}</metadata>
 <metadata name="Application">kinetix</metadata>
 <resources>
  <basematerials id="1">
   <base name="hard" displaycolor="#D8D8D2FF"/>
   <base name="soft" displaycolor="#2E6FB7FF"/>
  </basematerials>
)",
                  cura ? fmt::format(" xmlns:cura=\"{}\"", cura_space) : "", escape_marks(content.name));
  const bool is_joined = content.meshes.size() > 1;
  for (const MeshObject& object : content.meshes) {
    const std::optional<int> extruder =
        is_joined ? std::optional(object.ranges.front().material) : std::nullopt;
    out += object_xml(object, cura ? cura_metadata(*cura, extruder) : "");
  }
  if (is_joined) out += joining_object_xml(content);
  return out + fmt::format(" </resources>\n <build>\n  <item objectid=\"{}\"/>\n </build>\n</model>\n",
                           content.built_id());
}

/// Returns the settings for PrusaSlicer: the ranges as volumes, each with its extruder.
std::string prusa_config(const Content& content, const SlicerSettings& settings) {
  const MeshObject& object = content.meshes.front();
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<config>\n <object id=\"{}\" instances_count=\"1\">\n"
      "  <metadata type=\"object\" key=\"name\" value=\"{}\"/>\n",
      object.id, escape_marks(content.name));
  for (const auto& [key, value] : settings)
    out += fmt::format("  <metadata type=\"object\" key=\"{}\" value=\"{}\"/>\n", key, value);
  for (const Range& range : object.ranges)
    out += fmt::format(
        "  <volume firstid=\"{}\" lastid=\"{}\">\n"
        "   <metadata type=\"volume\" key=\"name\" value=\"{}\"/>\n"
        "   <metadata type=\"volume\" key=\"volume_type\" value=\"ModelPart\"/>\n"
        "   <metadata type=\"volume\" key=\"extruder\" value=\"{}\"/>\n  </volume>\n",
        range.first, range.first + range.count - 1, range.name, range.material + 1);
  return out + " </object>\n</config>\n";
}

/// Returns the settings for Orca and Bambu: each mesh as a part, with its extruder.
std::string orca_config(const Content& content, const SlicerSettings& settings) {
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<config>\n <object id=\"{}\">\n"
      "  <metadata key=\"name\" value=\"{}\"/>\n  <metadata key=\"extruder\" value=\"1\"/>\n",
      content.built_id(), escape_marks(content.name));
  for (const auto& [key, value] : settings)
    out += fmt::format("  <metadata key=\"{}\" value=\"{}\"/>\n", key, value);
  for (const MeshObject& object : content.meshes)
    out += fmt::format(
        "  <part id=\"{}\" subtype=\"normal_part\">\n   <metadata key=\"name\" value=\"{}\"/>\n"
        "   <metadata key=\"extruder\" value=\"{}\"/>\n  </part>\n",
        object.id, escape_marks(object.name), object.ranges.front().material + 1);
  return out + " </object>\n</config>\n";
}

constexpr int first_mesh_id = 2;  // 1 has the materials

/// Returns one mesh, its materials as ranges of triangles.
std::vector<MeshObject> one_mesh(const PrintJob& job, const std::string& name, model::Polyhedron all,
                                 const model::Polyhedron& soft) {
  std::vector<Range> ranges{{"hard", 0, 0, all.triangles.size()}};
  if (job.sheet.is_one_material())
    ranges.front().count += soft.triangles.size();
  else if (!soft.triangles.empty())
    ranges.push_back({"soft", 1, all.triangles.size(), soft.triangles.size()});
  append(soft, all);
  return {{first_mesh_id, name, std::move(all), std::move(ranges)}};
}

/// Returns a mesh for each material.
std::vector<MeshObject> two_meshes(model::Polyhedron hard, model::Polyhedron soft) {
  const std::vector<Range> all_hard{{"hard", 0, 0, hard.triangles.size()}},
      all_soft{{"soft", 1, 0, soft.triangles.size()}};
  return {{first_mesh_id, "hard", std::move(hard), all_hard},
          {first_mesh_id + 1, "soft", std::move(soft), all_soft}};
}

NamedContent package(const PrintJob& job, const std::string& name, model::Polyhedron hard,
                     model::Polyhedron soft) {
  const bool is_separate = has_separate_materials(job) && !soft.triangles.empty();
  const Content content{name, is_separate ? two_meshes(std::move(hard), std::move(soft))
                                          : one_mesh(job, name, std::move(hard), soft)};
  const std::vector<Slicer> slicers = slicers_for(job);
  const auto settings_of = [&](Slicer slicer) -> std::optional<SlicerSettings> {
    if (std::find(slicers.begin(), slicers.end(), slicer) == slicers.end()) return std::nullopt;
    return object_settings(slicer, job, slicers.size() > 1);
  };
  std::vector<NamedContent> files{{"[Content_Types].xml", content_types},
                                  {"_rels/.rels", relationships},
                                  {"3D/3dmodel.model", model_xml(content, settings_of(Slicer::cura))}};
  if (const auto prusa = settings_of(Slicer::prusa))
    files.push_back({"Metadata/Slic3r_PE_model.config", prusa_config(content, *prusa)});
  auto orca = settings_of(Slicer::orca);
  if (!orca) orca = settings_of(Slicer::bambu);
  if (orca) files.push_back({"Metadata/model_settings.config", orca_config(content, *orca)});
  return {name + ".3mf", zip_text(files)};
}

std::vector<NamedContent> write_threemf(const PrintJob& job) {
  const std::string& name = job.sheet.name;
  std::vector<NamedContent> files{package(job, name, hard_part(job), soft_part(job))};
  if (model::Polyhedron rods = laid_out_rods(job.sheet); !rods.points.empty())
    files.push_back(package(job, name + "_rods", std::move(rods), {}));
  if (!job.sheet.clip.points.empty())
    files.push_back(package(job, name + "_clip", rounded_for_file(job.sheet.clip), {}));
  if (job.sheet.tiles.count() > 1)
    for (int tile = 0; tile < job.sheet.tiles.count(); ++tile) {
      TileParts parts = tile_parts(job, tile);
      files.push_back(package(job, name + "_tile_" + std::to_string(tile + 1), std::move(parts.hard),
                              std::move(parts.soft)));
    }
  return files;
}

}  // namespace

// Entry of the format 3mf: name, meaning and writer.
const PrintFormat threemf_format = {
    .name = "3mf", .meaning = "slicers, with both materials", .write = write_threemf, .lies_on_bed = true};

}  // namespace kinetix::app
