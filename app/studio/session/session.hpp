#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/run/run.hpp"
#include "app/studio/play/equilibria.hpp"
#include "app/studio/play/player.hpp"
#include "app/studio/session/autosave.hpp"
#include "app/studio/session/design_history.hpp"
#include "app/studio/session/job.hpp"
#include "app/studio/session/parts.hpp"
#include "app/studio/session/session_loop.hpp"

namespace kinetix::app::studio {

/// What `view` was asked to open.
struct Opened {
  Design design;
  std::string save_file;    ///< that the design was read from, where `save` writes it; empty: none
  std::string target_file;  ///< not empty: searched for at once
  int threads = 0;
  std::uint64_t seed = 0;
  nlohmann::ordered_json result =
      {};                           ///< the message of the result that the design is of; null: none is known
  std::string results = "results";  ///< the folder in which `save` makes one for what was read from no file
  std::shared_ptr<Autosave> autosave = {};  ///< where what is not saved is kept; null: nowhere
};

/// Bodies of the largest sheet that is opened: 500 x 500 cells. Its message has 150 MB; more than twice that no browser reads.
inline constexpr int most_bodies = 300'000;
/// @throws InvalidInput for a design that the page cannot show
void require_showable(const Design& design);

/// A design in the studio, its shape at the moment, and what runs on its behalf.
class Session : public SessionLoop {
 public:
  Session(Opened opened, Outlet outlet);

 private:
  using Command = std::function<void(Session& session, const Message& message)>;
  static const std::map<std::string, Command>& commands();

  void welcome(int client) override;
  void forget(int client) override { parts_.erase(client); }
  void obey(const Message& message) override;
  bool moves() const override { return player_.plays(); }
  bool play() override;
  void halt() override;
  Frame frame() const override;
  void stop_jobs() override;

  int body_of(const Message& message) const;
  void set_mode(const Message& message);
  void enter(Mode mode);
  void fold_to(double theta);
  void drag(const Message& message);
  void take(Design design, Finding finding = {});
  void take_other(Design design, Finding finding = {});
  void add(Design design, int thing, Finding finding);
  void go_back(bool forth);
  void design_changed();
  void take_nearest();
  void open(const Message& message);
  void save(const Message& message);
  void save_result_beside(const std::string& folder) const;
  void keep_unsaved();
  std::filesystem::path save_file();
  void take_part(const Message& message);
  void search(const Message& message);
  void export_files(const Message& message);

  void follow();
  void take(std::shared_ptr<const BodiesWay> way, double theta);
  void cut_for(Mode mode);

  void start(Job& job, double id, const std::string& about, const Job::Work& work);
  void show_flat();
  struct NewestShape;
  void trace(double theta);
  void show_newest(int number, NewestShape& newest);
  void dropped(int client, double id);
  void snap();
  void search_for(const std::string& file, std::shared_ptr<const void> keeps);
  void found(std::shared_ptr<Run> run);

  void tell_design(int client = everybody);
  void tell_result(int client = everybody) const;
  void tell_path(int client = everybody) const;
  void tell_state(int client = everybody) const;

  const Opened opened_;
  DesignHistory history_;
  std::vector<std::string> save_files_;  ///< by thing of the history; empty: not asked for yet
  int revision_ = 1;
  int restored_ = 0;      ///< revision of the design that a studio which was killed had left; 0: none
  std::string not_kept_;  ///< why what is not saved is kept nowhere; empty: it is kept
  Text design_text_;      ///< the newest message `design`
  bool is_told_ = true;   ///< everybody was told of the newest design
  Player player_;
  std::shared_ptr<const KnownWay> way_;        ///< of the present design's equilibria, as far as it is known
  std::shared_ptr<const KnownWay> stable_of_;  ///< that way led to the stable states
  nlohmann::ordered_json path_;                ///< rows of that way for the page; null: none is known
  int traces_ = 0;                             ///< that were begun: what older ones say counts no more
  std::vector<model::StableState> stable_;     ///< that the last equilibrium path led to
  std::size_t next_stable_ = 0;

  bool searching_ = false, exporting_ = false;
  std::optional<Mode> awaited_;  ///< for which bodies are being cut; nothing once another one was asked for
  /// Held while the physics engine runs, which has global state: in the hands of a search that checks its result the thing
  /// stands still.
  std::mutex engine_;
  std::shared_ptr<const Design>
      meshes_of_;               ///< whose message `meshes` everybody has; null: none was of bodies
  std::map<int, Parts> parts_;  ///< by client: of files that came for its next search

  Job tracer_, searcher_, exporter_, follower_, cutter_;  ///< last: they end before what they speak to
};

}  // namespace kinetix::app::studio
