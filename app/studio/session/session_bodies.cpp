#include "app/pipeline/body_pieces.hpp"
#include "app/pipeline/closed_way.hpp"
#include "app/studio/session/session.hpp"

namespace kinetix::app::studio {

/// Computes the motion of bodies if it is not known yet, and then its collisions.
void Session::follow() {
  if (!player_.moving().bodies || player_.moving().way->meets) return;
  const Design& design = history_.current();
  const double theta = player_.moving().way->followed ? 0 : asked_theta(design, player_.moving());
  start(follower_, 0, type_,
        [this, revision = revision_, theta, pull = pull_of(design),
         moving = player_.moving()](const std::stop_token& asked) {
          const auto stop = [&] { return asked.stop_requested(); };
          const auto send_motion = [&](const BodiesMotion& way, double to) {
            if (stop()) return;
            enqueue([this, revision, to, way = std::make_shared<const BodiesMotion>(way)] {
              if (revision == revision_) take(way, to);
            });
          };
          BodiesMotion way = *moving.way;
          if (!way.followed) send_motion(way = way_of(moving.linkage, way.hinge, pull, stop), theta);
          const model::Assembly& assembly = *moving.bodies->structure.assembly();
          way.meets = {first_meeting(assembly, way, -1, stop), first_meeting(assembly, way, 1, stop)};
          send_motion(way, 0);
        });
}

void Session::take(std::shared_ptr<const BodiesMotion> way, double theta) {
  player_.take(std::move(way));
  send_design();
  if (theta != 0) fold_to(theta);
  changed_ = true;
}

/// Cuts bodies into convex pieces for collisions, once and in the background, and then enters the mode.
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
    enqueue([this, client, id, of = moving.bodies, parts, pressing] {
      const bool is_shown = have_one_shape(of.get(), player_.moving().bodies.get());
      if (is_shown) player_.take(parts, pressing);
      note_heard(client, id);
      changed_ = true;
      if (const auto wanted = std::exchange(awaited_, {}); wanted && is_shown) enter(*wanted);
    });
  });
}

}  // namespace kinetix::app::studio
