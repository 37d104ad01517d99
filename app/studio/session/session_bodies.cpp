#include "app/pipeline/body_pieces.hpp"
#include "app/studio/session/session.hpp"

namespace kinetix::app::studio {

void Session::turn_by(const Message& message) {
  const Moving& moving = player_.moving();
  if (!moving.bodies) throw InvalidInput("driven: is of designs of bodies");
  const auto& hinges = moving.linkage.hinges;
  const int hinge = message.integer("hinge", 0, static_cast<int>(hinges.size()) - 1);
  if (hinges[hinge].ball) throw InvalidInput("hinge: is a ball, which has no axis to be turned about");
  player_.turn_by(hinge);
  design_changed();
  follow(0, {});
}

/// Finds the way of the hinge that is turned, and then looks it through for bodies that meet.
/// @param theta to which it is then turned, rad   @param pull of the bodies, instead of a turned hinge
void Session::follow(double theta, const std::optional<model::Pull>& pull) {
  start(follower_, 0, type_,
        [this, revision = revision_, theta, pull, moving = player_.moving()](const std::stop_token& asked) {
          const auto stop = [&] { return asked.stop_requested(); };
          const auto tell_way = [&](const BodiesWay& way, double to) {
            if (stop()) return;
            enqueue([this, revision, to, way = std::make_shared<const BodiesWay>(way)] {
              if (revision == revision_) take(way, to);
            });
          };
          BodiesWay way = way_of(moving.linkage, moving.way->hinge, pull, stop);
          tell_way(way, theta);
          const model::Assembly& assembly = *moving.bodies->structure.assembly();
          way.meets = {first_meeting(assembly, way, -1, stop), first_meeting(assembly, way, 1, stop)};
          tell_way(way, 0);
        });
}

void Session::take(std::shared_ptr<const BodiesWay> way, double theta) {
  player_.take(std::move(way));
  tell_design();
  if (theta != 0) fold_to(theta);
  changed_ = true;
}

/// Bodies collide by convex pieces, which are cut once and take a while.
void Session::cut_for(Mode mode) {
  awaited_ = mode;
  const double id = std::exchange(id_, 0);
  start(cutter_, id, type_, [this, client = client_, id, moving = player_.moving()](const std::stop_token&) {
    const model::Assembly& assembly = *moving.bodies->structure.assembly();
    const BodyPieces pieces = pieces_of(assembly, opened_.threads);
    const auto parts = std::make_shared<const sim::ContactParts>(contact_parts(pieces, assembly));
    std::unique_lock alone(engine_);
    const auto pressing =
        std::make_shared<const model::ConvexBodies>(convex_bodies(pieces, assembly, moving.linkage));
    alone.unlock();
    enqueue([this, client, id, parts, pressing] {
      player_.take(parts, pressing);
      note_heard(client, id);
      changed_ = true;
      if (const auto wanted = std::exchange(awaited_, {})) enter(*wanted);
    });
  });
}

}  // namespace kinetix::app::studio
