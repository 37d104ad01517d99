#pragma once

#include "app/studio/assembly/assembly_message.hpp"
#include "app/studio/session/job.hpp"
#include "app/studio/session/session_loop.hpp"

namespace kinetix::app::studio {

/// A design of bodies in the studio: turned by one of its hinges, or played with in the engine. Nothing of it is edited.
class AssemblySession : public SessionLoop {
 public:
  /// @param threads that cut bodies into convex pieces; 0: as many as there are
  AssemblySession(AssemblyFile file, int threads, Outlet outlet);

 private:
  using Command = std::function<void(AssemblySession& session, const Message& message)>;
  static const std::map<std::string, Command>& commands();

  void welcome(int client) override;
  void forget(int) override {}
  void obey(const Message& message) override;
  bool moves() const override { return player_.plays(); }
  bool play() override;
  void halt() override;
  Frame frame() const override;
  void stop_jobs() override;

  int body_of(const Message& message) const;
  void set_mode(const Message& message);
  void enter_engine();
  void start(Job& job, double id, const std::function<void(const std::stop_token&)>& work);
  void drive_by(int hinge, double theta, const std::optional<model::Pull>& pull = {});
  void take(const AssemblyWay& way, double theta);
  void tell_design(int client = everybody) const;
  void tell_state(int client = everybody) const;

  AssemblyPlayer player_;
  const int threads_;
  int revision_ = 1;
  WayKnown known_;                                  ///< of the present driven hinge
  std::shared_ptr<const sim::ContactParts> parts_;  ///< of the engine; null until it was asked for
  bool awaits_engine_ = false;  ///< bodies are being cut for the engine, which is still wanted
  Job follower_, cutter_;       ///< last: they end before what they speak to
};

}  // namespace kinetix::app::studio
