#pragma once

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <stop_token>

#include "app/run/run.hpp"
#include "app/studio/design_history.hpp"
#include "app/studio/job.hpp"
#include "app/studio/message.hpp"
#include "app/studio/parts.hpp"
#include "app/studio/player.hpp"
#include "app/studio/sheet_equilibria.hpp"

namespace kinetix::app::studio {

inline constexpr int everybody = -1;  ///< in the place of a client's number: all of them

/// Where a session speaks to its pages. Calls come from several threads.
struct Outlet {
  std::function<void(int client, std::string text)> tell;
  std::function<void(std::shared_ptr<const Frame> frame)> show;
};

/// What `view` was asked to open.
struct Opened {
  DesignFile design;
  std::string save_file;    ///< where `save` writes the design
  std::string target_file;  ///< not empty: searched for at once
  int threads = 0;
  std::uint64_t seed = 0;
  nlohmann::ordered_json result =
      {};  ///< the message of the result that the design is of; null: none is known
};

/// One thing in the studio: its design, its shape at the moment, and what runs on its behalf. All pages see the same.
/// Everything happens on the thread of run(), one command after the other, but for long work, whose results come back
/// to it.
class Session {
 public:
  Session(Opened opened, Outlet outlet);

  /// A command as the page sent it; from any thread.
  void post(int client, std::string text);
  /// A page came, and is told everything; from any thread.
  void greet(int client);
  /// A page went; from any thread. The engine rests while there is none.
  void dismiss(int client);
  /// Until asked to stop.
  void run(const std::stop_token& stop);

 private:
  using Command = std::function<void(Session& session, const Message& message)>;
  static const std::map<std::string, Command>& commands();

  void note_heard(int client, double id);
  bool plays() const;
  void enqueue(std::function<void()> work);
  void wait_for_work(const std::stop_token& stop);
  void do_queued();
  void obey(int client, const std::string& text);

  int body_of(const Message& message) const;
  void set_mode(const Message& message);
  void fold_to(double theta);
  void drag(const Message& message);
  void take(DesignFile design);
  void design_changed();
  void take_nearest();
  void open(const Message& message);
  void save();
  void take_part(const Message& message);
  void search(const Message& message);
  void export_files(const Message& message);

  void trace(double theta);
  void dropped(int client, double id);
  void snap();
  void search_for(const std::string& file, std::shared_ptr<void> keeps);
  void found(std::shared_ptr<Run> run);

  void show();
  void tell(const nlohmann::ordered_json& message, int client = everybody) const;
  void tell_state(int client = everybody) const;

  const Opened opened_;
  const Outlet outlet_;
  DesignHistory history_;
  int revision_ = 1;
  Player player_;
  std::shared_ptr<const Run> result_;  ///< of the last search, while its design is the present one
  nlohmann::ordered_json
      told_;  ///< the message of the result that the present design is of; null: it is of none
  std::shared_ptr<const KnownWay> way_;        ///< of the present design's equilibria, as far as it is known
  std::shared_ptr<const KnownWay> stable_of_;  ///< that way led to the stable states
  int traces_ = 0;                             ///< that were begun: what older ones say counts no more
  std::vector<model::StableState> stable_;     ///< that the last equilibrium path led to
  std::size_t next_stable_ = 0;

  std::map<int, double> heard_;  ///< by client that is there: id of its last command whose effect can be seen
  int client_ = everybody;       ///< whose command is being done
  double id_ = 0;                ///< of that command; 0 once somebody else answers it
  bool changed_ = true;          ///< there is something new to see
  bool searching_ = false, exporting_ = false;
  /// Held while the physics engine runs, which has global state: in the hands of a search that checks its result the thing
  /// stands still.
  std::mutex engine_;
  std::map<int, Parts> parts_;  ///< by client: of files that came for its next search

  std::mutex mutex_;  ///< of the queue
  std::condition_variable_any arrived_;
  std::deque<std::function<void()>> queue_;
  Job tracer_, searcher_, exporter_;  ///< last: they end before what they speak to
};

}  // namespace kinetix::app::studio
