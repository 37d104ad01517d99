#pragma once

#include "app/run/run.hpp"
#include "app/studio/play/equilibria.hpp"
#include "app/studio/play/player.hpp"
#include "app/studio/session/autosave.hpp"
#include "app/studio/session/design_edits.hpp"
#include "app/studio/session/session_loop.hpp"
#include "app/studio/session/uploads.hpp"

namespace kinetix::app::studio {

/// Input of a session: the design that `view` opens and its options.
struct SessionInput {
  Design design;
  std::string save_file = {};                ///< file of the design, where `save` writes it; empty: none
  std::optional<targets::Node> target = {};  ///< searched for at the start
  int threads = 0;
  std::uint64_t seed = 0;
  nlohmann::ordered_json result = {};       ///< message of the design's result; null: none
  std::string results = "results";          ///< folder where `save` makes one for a design without a file
  std::shared_ptr<Autosave> autosave = {};  ///< keeps unsaved designs; null: they are not kept
};

/// Bodies of the largest sheet that is opened: 500 x 500 cells. Its message has 150 MB; browsers cannot read
/// much more than twice that.
inline constexpr int max_bodies = 300'000;
/// @throws InvalidInput for a design that the page cannot show
void require_showable(const Design& design);

/// A design in the studio, its present shape, and its running work.
class Session : public SessionLoop {
 public:
  Session(SessionInput opened, MessageSink outlet);

 private:
  using Command = std::function<void(Session& session, const Message& message)>;
  static const std::map<std::string, Command>& commands();

  void welcome(int client) override;
  void forget(int client) override { parts_.erase(client); }
  void execute(const Message& message) override;
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
  void take(Design design, DesignResult design_result = {});
  void replace_design(Design design, DesignResult design_result = {});
  void add(Design design, int thing, DesignResult design_result);
  void step_history(bool forth);
  void design_changed();
  void apply_nearest_design();
  void open(const Message& message);
  void save(const Message& message);
  void save_result_beside(const std::string& folder) const;
  void keep_unsaved();
  std::filesystem::path save_file();
  void receive_part(const Message& message);
  void search(const Message& message);
  void export_files(const Message& message);

  void follow();
  void take(std::shared_ptr<const BodiesMotion> motion, double theta);
  void cut_pieces_for(Mode mode);

  void start(Job& job, double id, const std::string& about, const Job::Work& work);
  void show_flat();
  struct NewestShape;
  void trace(double theta);
  void show_newest(int number, NewestShape& newest);
  void dropped(int client, double id);
  void snap();
  void search_for(const targets::Node& root, std::shared_ptr<const std::filesystem::path> folder);
  void found(std::shared_ptr<Run> run);

  void send_design(int client = all_clients);
  void send_last_result(int client = all_clients) const;
  void send_path(int client = all_clients) const;
  void send_state(int client = all_clients) const;

  const SessionInput input_;
  DesignHistory history_;
  std::vector<std::string> save_files_;  ///< by thing of the history; empty: not chosen yet
  int revision_ = 1;
  int restored_ = 0;      ///< revision of the design that a killed studio left; 0: none
  std::string not_kept_;  ///< why unsaved designs are not kept; empty: they are kept
  Text design_text_;      ///< newest message `design`
  bool is_sent_ = true;   ///< everybody has the newest design
  Player player_;
  std::shared_ptr<const KnownEquilibria> known_equilibria_;  ///< known equilibria of the present design
  std::shared_ptr<const KnownEquilibria> stable_of_;         ///< source of the stable states
  nlohmann::ordered_json path_;             ///< rows of the equilibrium path for the page; null: none
  int traces_ = 0;                          ///< number of traces; results of older ones are ignored
  std::vector<model::StableState> stable_;  ///< reached from the last equilibrium path
  std::size_t next_stable_ = 0;

  bool searching_ = false, exporting_ = false;
  std::optional<Mode> awaited_;  ///< waits until bodies are cut; empty after another request.
  /// Locked while the physics engine runs, which has global state. While a search checks its result, the
  /// shown engine stands still.
  std::mutex engine_;
  std::shared_ptr<const Design> meshes_of_;  ///< bodies of the last message `meshes`; null: none was sent
  std::map<int, Parts> parts_;               ///< per client: files sent for its next search

  Job tracer_, searcher_, exporter_, follower_, cutter_;  ///< last member: they end before what they use
};

}  // namespace kinetix::app::studio
