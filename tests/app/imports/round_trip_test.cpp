#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "model/base/geometry.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"

namespace kinetix::testing {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::json;

constexpr double turned_deg = 24;  // deg: turn of one hinge in both simulations
constexpr const char* flat_panel = R"(kinetix: 1
structure: {cells: [2, 2], cell_mm: 16, wall_mm: {thickness: 0.8, height: 6}}
design:
  theta_deg: 12
)";

Vector3d vector_of(const Json& v) { return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()}; }

Json result_in(const fs::path& folder) { return Json::parse(text_of(folder / "result.json")); }

Json structure_of(const std::string& file, const std::string& out) {
  const Outcome run = kinetix_opt("simulate " + file + " --model exact -o " + out);
  EXPECT_EQ(run.code, 0) << run.err;
  const Json result = result_in(out);
  EXPECT_EQ(schema_errors(result), "");
  return result["structure"];
}

Json verified(const std::string& file, const std::string& out) {
  const Outcome run = kinetix_opt("verify " + file + " -o " + out);
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  return result_in(out);
}

/// A sheet and its own results, from its design file.
class Sheet {
 public:
  /// @param design without a drive
  explicit Sheet(const std::string& design) : design_(design) {
    structure_ = structure_of(file(), (scratch_ / "run").string());
    driven_ = structure_["hinges"].size() / 2;
  }

  std::string file() const { return scratch_.write("sheet.yaml", design_); }
  const Json& structure() const { return structure_; }
  /// Returns the hinge that the simulation turns.
  std::size_t driven() const { return driven_; }

  /// Returns the result of the simulation, which runs once.
  const Json& folded() {
    if (!folded_.is_null()) return folded_;
    const auto vertex = [&](int k) {
      return structure_["bodies"][structure_["hinges"][driven_]["bodies"][k].get<int>()]["vertex"].dump();
    };
    const std::string drive = "drive: {kind: hinge, wall: [" + vertex(0) + ", " + vertex(1) +
                              "], angle_deg: " + std::to_string(turned_deg) + "}\n";
    folded_ = verified(scratch_.write("driven.yaml", design_ + drive), (scratch_ / "run").string());
    return folded_;
  }

 private:
  Scratch scratch_;
  std::string design_;
  Json structure_, folded_;
  std::size_t driven_ = 0;
};

/// A sheet, and the import of a file of its solids.
class RoundTrip {
 public:
  RoundTrip(Sheet& sheet, const std::string& hinge, const std::string& format)
      : sheet_(sheet), original_(sheet.structure()) {
    const std::string file = sheet.file();
    const Outcome made =
        kinetix_opt("export " + file + " --hinge " + hinge + " --format " + format + " -o " + at("made"));
    EXPECT_EQ(made.code, 0) << made.err;
    const std::string source = format != "stl" ? at("made/sheet.") + format
                               : hinge == "pin"
                                   ? at("made/all.stl")
                                   : "--hard " + at("made/hard.stl") + " --soft " + at("made/soft.stl");
    const Outcome found = kinetix_opt("import " + source + " -o " + at("found") + " --json");
    EXPECT_EQ(found.code, 0) << found.err;
    imported_ = structure_of(at("found/design.yaml"), at("run"));
    match();
  }

  std::size_t bodies() const { return imported_["bodies"].size(); }
  std::size_t hinges() const { return imported_["hinges"].size(); }
  bool has_the_same_counts() const {
    return original_["bodies"].size() == bodies() && original_["hinges"].size() == hinges();
  }
  double axis_off_deg = 0, point_off_mm = 0;

  /// Computes the rms and maximum distance of the vertices after both simulations, cell edges.
  std::pair<double, double> physics_apart() {
    const Json& own = original_["hinges"][sheet_.driven()];
    const Json& found = imported_["hinges"][hinge_of_[sheet_.driven()]];
    const std::string name = found["name"];
    const bool same_way = vector_of(own["axis"]).dot(vector_of(found["axis"])) > 0;
    const bool same_order = body_of_[own["bodies"][0]] == found["bodies"][0].get<int>();
    const double angle = same_way == same_order ? turned_deg : -turned_deg;
    std::string text = text_of(at("found/design.yaml"));
    text = text.substr(0, text.find("drive:")) + "drive: {hinge: " + name +
           ", angle_deg: " + std::to_string(angle) + "}\n";
    return apart(sheet_.folded(), verified(scratch_.write("found/driven.yaml", text), at("run")));
  }

 private:
  std::string at(const std::string& name) const { return (scratch_ / name).string(); }

  /// Computes the shift between the file and the sheet: they differ by a translation at most.
  Vector3d shift() const {
    Vector3d sum = Vector3d::Zero();
    for (const Json& h : imported_["hinges"]) sum += vector_of(h["point_mm"]);
    for (const Json& h : original_["hinges"]) sum -= vector_of(h["point_mm"]);
    return sum / static_cast<double>(hinges());
  }

  void match() {
    if (!has_the_same_counts()) return;
    shift_ = shift();
    std::map<int, std::set<int>> bodies;
    for (const Json& own : original_["hinges"]) {
      const Vector3d point = vector_of(own["point_mm"]) + shift_;
      int nearest = 0;
      double least = INFINITY;
      for (int k = 0; k < static_cast<int>(hinges()); ++k)
        if (const double d = (vector_of(imported_["hinges"][k]["point_mm"]) - point).norm(); d < least) {
          least = d;
          nearest = k;
        }
      const Json& found = imported_["hinges"][nearest];
      const Vector3d a = vector_of(own["axis"]), b = vector_of(found["axis"]);
      point_off_mm = std::max(point_off_mm, least);
      axis_off_deg = std::max(axis_off_deg, to_degrees(std::atan2(a.cross(b).norm(), std::abs(a.dot(b)))));
      hinge_of_.push_back(nearest);
      keep_common(own, found, bodies);
    }
    EXPECT_EQ(std::set<int>(hinge_of_.begin(), hinge_of_.end()).size(), hinges());
    settle(bodies);
  }

  static void keep_common(const Json& own, const Json& found, std::map<int, std::set<int>>& bodies) {
    const std::set<int> ends{found["bodies"][0].get<int>(), found["bodies"][1].get<int>()};
    for (const Json& b : own["bodies"]) {
      auto [known, is_new] = bodies.try_emplace(b.get<int>(), ends);
      if (!is_new) std::erase_if(known->second, [&](int k) { return !ends.contains(k); });
    }
  }

  /// Assigns each body its imported body. A body with one hinge has two candidates; its neighbour excludes one of them.
  void settle(std::map<int, std::set<int>> bodies) {
    for (bool goes_on = true; goes_on;) {
      goes_on = false;
      for (auto& [b, ends] : bodies) {
        if (ends.size() != 1 || body_of_.contains(b)) continue;
        body_of_[b] = *ends.begin();
        goes_on = true;
        for (auto& [other, theirs] : bodies)
          if (other != b) theirs.erase(body_of_[b]);
      }
    }
    EXPECT_EQ(body_of_.size(), this->bodies());
  }

  static const Json& physics_poses(const Json& result) {
    for (const Json& state : result["states"])
      if (state["model"] == "bullet") return state["poses"];
    throw std::runtime_error("no physics run");
  }

  std::pair<double, double> apart(const Json& before, const Json& after) {
    const auto n = static_cast<Eigen::Index>(bodies());
    Eigen::Matrix3Xd own(3, n), found(3, n);
    for (Eigen::Index b = 0; b < n; ++b) {
      const int k = body_of_.at(static_cast<int>(b));
      const Json &pose = physics_poses(after)[k], &q = pose["quaternion_wxyz"];
      const Vector3d vertex = vector_of(original_["bodies"][b]["position_mm"]) + shift_,
                     center = vector_of(imported_["bodies"][k]["position_mm"]);
      own.col(b) = vector_of(physics_poses(before)[b]["position_mm"]);
      found.col(b) =
          vector_of(pose["position_mm"]) +
          Eigen::Quaterniond(q[0].get<double>(), q[1].get<double>(), q[2].get<double>(), q[3].get<double>()) *
              (vertex - center);
    }
    const Eigen::Matrix4d X = rigid_fit(found, own);
    const Eigen::RowVectorXd off =
        ((X.topLeftCorner<3, 3>() * found).colwise() + Vector3d(X.topRightCorner<3, 1>()) - own)
            .colwise()
            .norm();
    const double edge = original_["cell_mm"];
    return {std::sqrt(off.squaredNorm() / static_cast<double>(n)) / edge, off.maxCoeff() / edge};
  }

  Scratch scratch_;
  Sheet& sheet_;
  const Json& original_;
  Json imported_;
  Vector3d shift_ = Vector3d::Zero();
  std::vector<int> hinge_of_;
  std::map<int, int> body_of_;
};

void expect_the_same_structure(const RoundTrip& trip) {
  ASSERT_TRUE(trip.has_the_same_counts()) << trip.bodies() << " bodies, " << trip.hinges() << " hinges";
  EXPECT_LT(trip.axis_off_deg, 0.1);
  EXPECT_LT(trip.point_off_mm, 0.02);
}

void expect_the_same(Sheet& sheet, const std::string& hinge, const std::string& format) {
  SCOPED_TRACE(hinge + " as " + format);
  RoundTrip trip(sheet, hinge, format);
  ASSERT_NO_FATAL_FAILURE(expect_the_same_structure(trip));
  const auto [rms, max] = trip.physics_apart();
  EXPECT_LT(rms, 2e-2);
  EXPECT_LT(max, 2e-2);
}

/// Returns the design of a search, folded by 12 degrees, with hinges that the export chooses.
std::string searched(const std::string& goal_file) {
  const Scratch scratch;
  const Outcome run = kinetix_opt(goal_file + " --no-verify -o " + (scratch / "out").string());
  EXPECT_LE(run.code, 3) << run.err;
  std::string text = text_of(scratch / "out" / "design.yaml");
  text = std::regex_replace(text, std::regex("name: \"[^\"]*\""), "name: sheet",
                            std::regex_constants::format_first_only);
  text = std::regex_replace(text, std::regex("theta_deg: [-0-9.e]+"), "theta_deg: 12",
                            std::regex_constants::format_first_only);
  return std::regex_replace(text, std::regex("\n(drive|hinge): \\{[^\n]*"), "\n");
}

/// Returns the design of a search for this target with walls of 0.8 x 6 mm, as above.
std::string searched(const std::string& target, const std::string& cells) {
  const Scratch scratch;
  return searched(scratch.write("goal.yaml", "kinetix: 1\nname: \"sheet\"\ntarget: " + target +
                                                 "\nstructure: {" + cells +
                                                 ", wall_mm: {thickness: 0.8, height: 6}}\n"));
}

std::string shipped_target(const std::string& shape) {
  return KINETIX_SOURCE "/targets/shapes/" + shape + ".yaml";
}

void expect_pins_and_blocks_back(const std::string& design) {
  Sheet sheet(design);
  for (const char* hinge : {"pin", "block"}) expect_the_same(sheet, hinge, "3mf");
}

/// The many convex pieces of its pins make the simulation slow.
void expect_letter_back(const std::string& design) {
  Sheet sheet(design);
  expect_the_same_structure({sheet, "pin", "3mf"});
  expect_the_same(sheet, "block", "3mf");
}

TEST(Import, GivesASmallStripBack) {
  expect_pins_and_blocks_back(searched("{kind: curve, points: [[0, 0], [10, 8], [24, 12], [38, 8], [48, 0]]}",
                                       "cells: [5, 1], cell_mm: 12"));
}

TEST(Import, GivesASmallFoldBack) {
  expect_pins_and_blocks_back(searched(
      "{kind: fold, net: {faces: [{name: a, cells: [1, 1]}, {name: b, cells: [1, 1]}, {name: c, cells: [1, "
      "1]}], creases: [{faces: [a, b], side: right, angle_deg: 90}, {faces: [a, c], side: top, angle_deg: "
      "90}]}}",
      "cell_mm: 10"));
}

TEST(Import, GivesASmallLetterBack) {
  expect_letter_back(
      searched("{kind: display, rows: [\"0000\", \"0100\", \"0110\", \"0000\"]}", "cell_mm: 10"));
}

TEST(ImportSoak, GivesTheHelmetRibBack) {
  expect_pins_and_blocks_back(searched(shipped_target("helmet_rib")));
}

TEST(ImportSoak, GivesTheCubeBack) { expect_pins_and_blocks_back(searched(shipped_target("cube"))); }

TEST(ImportSoak, GivesTheLetterTBack) { expect_letter_back(searched(shipped_target("letter_t"))); }

TEST(Import, GivesAPanelBackFromEveryFormat) {
  Sheet sheet(flat_panel);
  for (const char* hinge : {"pin", "block"}) {
    expect_the_same(sheet, hinge, "3mf");
    for (const char* format : {"stl", "step", "glb"}) {
      SCOPED_TRACE(hinge + (" as " + std::string(format)));
      expect_the_same_structure({sheet, hinge, format});
    }
  }
}

}  // namespace
}  // namespace kinetix::testing
