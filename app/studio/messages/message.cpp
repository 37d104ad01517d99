#include "app/studio/messages/message.hpp"

#include <fmt/format.h>
#include <filesystem>
#include <new>
#include <system_error>

#include "app/print/format/print_format.hpp"
#include "app/result/state_json.hpp"
#include "app/run/plan.hpp"
#include "app/studio/messages/templates.hpp"
#include "app/version.hpp"
#include "targets/document/text_file.hpp"

namespace kinetix::app::studio {
namespace {

constexpr double farthest_mm = 1e6;           // a point a kilometre away is a slip of the mouse
constexpr std::size_t most_entries = 100000;  // per list, 1: more than any sheet has hinges

InvalidInput wrong(const char* key, const std::string& allowed) {
  return InvalidInput(fmt::format("{}: must be {}", key, allowed));
}

double number_of(const nlohmann::json& value, const char* key, double least, double most) {
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (number >= least && number <= most) return number;
  throw wrong(key, fmt::format("a number from {:g} to {:g}", least, most));
}

int integer_of(const nlohmann::json& value, const char* key, int least, int most) {
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (!(number >= least && number <= most && number == std::floor(number)))
    throw wrong(key, fmt::format("a whole number from {} to {}", least, most));
  return static_cast<int>(number);
}

std::string text_of(const nlohmann::json& value, const char* key) {
  if (!value.is_string()) throw wrong(key, "a text");
  return value.get<std::string>();
}

const nlohmann::json& list_of(const nlohmann::json& value, const char* key) {
  if (!value.is_array() || value.size() > most_entries) throw wrong(key, "a list");
  return value;
}

nlohmann::json parsed(std::string_view text) {
  if (targets::find_too_deep(text))
    throw InvalidInput("the command is nested too deep. Send at most " +
                       std::to_string(targets::max_document_depth) + " lists and maps in one another");
  return nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
}

}  // namespace

Message::Message(std::string_view text) : body_(parsed(text)) {
  if (body_.is_discarded() || !body_.is_object()) throw InvalidInput("a command is a JSON object");
  type_ = this->text("type");
  if (has("id")) id_ = number("id", 1, 1e15);
}

const nlohmann::json& Message::at(const char* key, const char* what) const {
  const auto found = body_.find(key);
  if (found == body_.end()) throw InvalidInput(fmt::format("{}: the key is missing. Give {}", key, what));
  return *found;
}

double Message::number(const char* key, double least, double most) const {
  return number_of(at(key, "a number"), key, least, most);
}

int Message::integer(const char* key, int least, int most) const {
  return integer_of(at(key, "a whole number"), key, least, most);
}

bool Message::boolean(const char* key) const {
  const nlohmann::json& value = at(key, "true or false");
  if (!value.is_boolean()) throw wrong(key, "true or false");
  return value.get<bool>();
}

std::string Message::text(const char* key) const { return text_of(at(key, "a text"), key); }

Eigen::Vector3d Message::point(const char* key) const {
  const nlohmann::json& value = at(key, "[x, y, z] in mm");
  if (!value.is_array() || value.size() != 3) throw wrong(key, "[x, y, z] in mm");
  Eigen::Vector3d point;
  for (int k = 0; k < 3; ++k) point[k] = number_of(value[k], key, -farthest_mm, farthest_mm);
  return point;
}

std::vector<double> Message::numbers(const char* key, double least, double most) const {
  std::vector<double> all;
  for (const auto& value : list_of(at(key, "a list of numbers"), key))
    all.push_back(number_of(value, key, least, most));
  return all;
}

std::vector<int> Message::integers(const char* key, int least, int most) const {
  std::vector<int> all;
  for (const auto& value : list_of(at(key, "a list of whole numbers"), key))
    all.push_back(integer_of(value, key, least, most));
  return all;
}

std::vector<std::string> Message::texts(const char* key) const {
  std::vector<std::string> all;
  for (const auto& value : list_of(at(key, "a list of texts"), key)) all.push_back(text_of(value, key));
  return all;
}

std::vector<std::pair<std::string, std::string>> Message::named_texts(const char* key) const {
  const nlohmann::json& value = at(key, "a map of texts");
  if (!value.is_object()) throw wrong(key, "a map of texts");
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& [name, entry] : value.items()) all.emplace_back(name, text_of(entry, key));
  return all;
}

std::string failure_message(const std::exception& error) {
  if (dynamic_cast<const InvalidInput*>(&error)) return error.what();
  if (dynamic_cast<const std::bad_alloc*>(&error))
    return "There is not enough memory for this. Take a smaller sheet, or close other programs.";
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error)) {
    const std::string path =
        file->path1().empty() ? "the folder that the studio was started in" : file->path1().string();
    return path + ": " + file->code().message() + ". Check that it is there and can be written.";
  }
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  if (system && system->code() == std::errc::resource_unavailable_try_again)
    return "No further thread or process can be started. Close other programs.";
  return std::string("internal error: ") + error.what();
}

std::string plain_number(double value, int digits) {
  constexpr double least = 0.01,
                   most = 99'999.5;  // larger numbers are easier to read with an exponent
  const double size = std::abs(value);
  if (value != 0 && !(size >= least && size < most)) return fmt::format("{:.{}g}", value, digits);
  const int before = value == 0 ? digits : static_cast<int>(std::floor(std::log10(size))) + 1;
  return fmt::format("{:.{}f}", value, std::max(0, digits - before));
}

namespace {

using Json = nlohmann::ordered_json;

Json hinge_json(const HingeSection& hinge) {
  if (!hinge.made)
    return {
        {"kind", "stiff"},
        {"text",
         fmt::format("They are revolute joints without clearance. Forces assume a stiffness of {} N/mm and "
                     "{} N mm/rad.",
                     plain_number(hinge.k_point), plain_number(hinge.k_turn))}};
  return {{"kind", to_string(hinge.made->kind)},
          {"material", hinge.made->material.name},
          {"text", hinge_text(hinge)}};
}

Json numbers(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

constexpr double rattles = 2 * radians_per_degree;  // rad: hinges that give way by less count as fixed

Json size_json(const model::Assembly& assembly) {
  Eigen::AlignedBox3d box;
  for (const model::AssemblyBody& body : assembly.bodies)
    for (const Eigen::Vector3d& p : body.solid.points) box.extend(p);
  const Eigen::Vector3d size = box.sizes();
  return {size.x(), size.y(), size.z()};
}

std::string describe_motion_end(const BodiesMotion& motion, int end, const model::Assembly& assembly) {
  if (motion.opens[end] < 0) return "";
  return fmt::format("Beyond {:.0f} degrees {} opens first.",
                     to_degrees(end == 0 ? motion.turns.front() : motion.turns.back()),
                     assembly.hinges[motion.opens[end]].name);
}

std::string describe_collision(const Collision& met, const model::Assembly& assembly) {
  return fmt::format("At {:.0f} degrees {} and {} run into each other.", to_degrees(met.turn),
                     assembly.bodies[met.bodies[0]].name, assembly.bodies[met.bodies[1]].name);
}

Json why(const BodiesMotion& motion, const model::Assembly& assembly) {
  if (!motion.followed) return {"How far it turns is being found."};
  Json out = Json::array();
  for (const std::string& words :
       {describe_motion_end(motion, 0, assembly), describe_motion_end(motion, 1, assembly)})
    if (!words.empty()) out.push_back(words);
  if (out.empty())
    out.push_back(fmt::format("All hinges stay closed from {:.0f} to {:.0f} degrees.",
                              to_degrees(motion.turns.front()), to_degrees(motion.turns.back())));
  if (!motion.meets) return out;
  const auto& [back, forth] = *motion.meets;
  for (const auto& met : {back, forth})
    if (met) out.push_back(describe_collision(*met, assembly));
  out.push_back(back || forth
                    ? "The analytic motion continues through colliding bodies. The simulation does not."
                    : "No bodies collide during the motion.");
  return out;
}

Json collisions_json(const BodiesMotion& motion) {
  if (!motion.meets) return nullptr;
  Json out = Json::array();
  for (const auto& met : *motion.meets)
    out.push_back(met ? Json{{"turn_rad", met->turn}, {"bodies", met->bodies}} : Json(nullptr));
  return out;
}

Json opener(int hinge) { return hinge < 0 ? Json(nullptr) : Json(hinge); }

}  // namespace

Json hello_message(const std::string& name) {
  Json out = {{"type", "hello"}, {"version", version}, {"name", name}};
  for (const char* list : {"templates", "processes", "materials", "formats"}) out[list] = Json::array();
  for (const Template& one : templates())
    out["templates"].push_back({{"name", one.name}, {"about", one.about}});
  for (const model::Process& process : model::processes()) out["processes"].push_back(process.name);
  for (const model::Material& material : model::materials()) out["materials"].push_back(material.name);
  for (const PrintFormat* format : print_formats())
    out["formats"].push_back({{"name", format->name}, {"about", format->meaning}});
  return out;
}

Json design_message(const Design& design, const Moving& moving) {
  if (moving.bodies) return bodies_message(design, moving);
  return {{"type", "design"},
          {"name", design.name},
          {"structure", sheet_json(design)},
          {"theta_rad", design.theta},
          {"theta_range_rad", {moving.min_theta, moving.max_theta}},
          {"exact", static_cast<bool>(moving.exact)},
          {"family", moving.exact.name},
          {"why", moving.exact.why},
          {"breaking", moving.nearest ? moving.nearest->changed : std::vector<int>{}},
          {"hinge", hinge_json(design.hinge)},
          {"drive", design.drive ? describe(*design.drive) : ""},
          {"flat_mm", numbers(flat_size(moving.linkage))}};
}

Json state_message(const Player& player) {
  const char* modes[] = {"exact", "equilibrium", "bullet"};
  return {{"type", "state"},
          {"mode", modes[static_cast<int>(player.mode())]},
          {"paused", player.paused()},
          {"gravity", player.gravity()},
          {"springs", player.springs()},
          {"speed", player.speed()},
          {"fixed", player.fixed()},
          {"driven", player.driven()}};
}

Json error_message(const std::string& what, double id, const std::string& about) {
  Json out = {{"type", "error"}, {"message", what}};
  if (!about.empty()) out["about"] = about;
  if (id > 0) out["id"] = id;
  return out;
}

Json progress_message(const char* job, const std::string& stage, double done, const std::string& so_far) {
  Json out = {{"type", "progress"},
              {"job", job},
              {"text", so_far.empty() ? stage : stage + ": " + so_far},
              {"done", nullptr},
              {"left_s", nullptr}};
  if (done >= 0) out["done"] = done;
  return out;
}

Json meshes_message(const model::Assembly& assembly) {
  Json out = {{"type", "meshes"}};
  out.update(meshes_json(assembly));
  return out;
}

Json bodies_message(const Design& design, const Moving& moving) {
  const model::Assembly& assembly = *design.structure.assembly();
  const BodiesMotion& motion = *moving.motion;
  return {{"type", "design"},
          {"name", design.name},
          {"structure", shown_bodies_json(assembly)},
          {"theta_rad", requested_theta(design, moving)},
          {"theta_range_rad", {moving.min_theta, moving.max_theta}},
          {"exact", motion.turns.back() - motion.turns.front() > rattles},
          {"family", moving.exact.name},
          {"why", why(motion, assembly)},
          {"breaking", Json::array()},
          {"hinge", {{"kind", "bodies"}, {"text", "as they were imported"}}},
          {"drive", motion.pulled ? "bodies that are pulled" : "one hinge that is turned"},
          {"flat_mm", size_json(assembly)},
          {"bodies",
           {{"driven", motion.hinge},
            {"pulled", motion.pulled},
            {"turn_per_theta", model::turn_at_theta(motion.sense, 1)},
            {"turn_range_rad", {motion.turns.front(), motion.turns.back()}},
            {"opens", {opener(motion.opens[0]), opener(motion.opens[1])}},
            {"meets", collisions_json(motion)},
            {"following", !motion.followed}}}};
}

}  // namespace kinetix::app::studio
