#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/console/console.hpp"
#include "tests/app/bow.hpp"
#include "tests/app/program.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* block_panel = R"(kinetix: 1
structure: {cells: [2, 1], cell_mm: 10, wall_mm: {thickness: 1, height: 4}}
design: {theta_deg: 20}
hinge: {kind: block, material: tango, gap_mm: 1.2}
)";

/// An impossible file name is bad input in every command and option.
TEST(FileNames, ThatAreTooLongAreBadInput) {
  const Scratch scratch;
  const std::string name(300, 'n'), design = scratch.write("panel.yaml", block_panel),
                                    target = scratch.write("bow.yaml", bow), out = (scratch / name).string(),
                                    deep = (scratch / name / "a/b").string();
  scratch.write("sweep.yaml",
                "kinetix: 1\nbase: panel.yaml\nmethod: {kind: factorial}\nfactors:\n  - {path: "
                "design.theta_deg, range: "
                "[5, 40]}\nresponses: [end_mm]\n");
  for (const std::string& words :
       {target + " -o " + out, "simulate " + design + " -o " + out, "simulate " + design + " -o " + deep,
        "verify " + design + " -o " + out, "sweep " + (scratch / "sweep.yaml").string() + " -o " + out,
        "export " + design + " --format stl -o " + out,
        "simulate " + design + " --model equilibrium --drives -o " + out, "check " + out, "simulate " + out,
        "sweep " + out, "export " + out + " --format stl", "import " + out, "import " + out + ".step",
        "import --hard " + out + ".stl --soft " + out + ".stl", "view --no-open " + out, out}) {
    const Outcome run = kinetix_opt(words + " --quiet");
    EXPECT_EQ(run.code, 2) << words << "\n" << run.err;
    EXPECT_THAT(run.err, HasSubstr(name.substr(0, 200)));
    EXPECT_THAT(run.err, Not(HasSubstr("filesystem"))) << words;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
}

/// \033 in a name of a file, a folder or an option colours the terminal, or worse.
TEST(FileNames, ArePrintedWithoutEscapeSequences) {
  const Scratch scratch;
  const std::string wild = "no\033[31m\a\xc2\x9b\xe2\x80\xae\xff";
  fs::create_directory(scratch / wild);
  const std::string folder = "'" + (scratch / wild).string() + "'",
                    design = "'" + scratch.write(wild + "/d\033.yaml", block_panel) + "'",
                    broken = "'" + scratch.write(wild + "/b\033.yaml", "kinetix: 7\n") + "'",
                    points = "'" +
                             scratch.write(wild + "/t.yaml",
                                           "kinetix: 1\ntarget: {kind: curve, points: none.csv}\n") +
                             "'";
  const auto is_clean = [](const std::string& text) {
    return std::all_of(text.begin(), text.end(),
                       [](char c) {
                         return c == '\n' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f &&
                                              static_cast<unsigned char>(c) != 0xff);
                       }) &&
           text.find("\xc2\x9b") == std::string::npos && text.find("\xe2\x80\xae") == std::string::npos;
  };
  for (const std::string& words : std::vector<std::string>{
           "check " + folder + "/none.yaml", "check " + folder, "check " + design, "check " + broken,
           "check " + points, "simulate " + design + " -o " + folder + "/out",
           "simulate " + design + " --model equilibrium -o " + folder + "/e",
           "export " + design + " --format stl,step -o " + folder + "/print",
           "import " + folder + "/none.stl",
           "import " + folder + "/print/hard.stl -o " + folder + "/imported", "'--wild\033[31m'",
           "'wild\033[31m'", "simulate " + design + " '--model=\033[31m'"}) {
    const Outcome run = kinetix_opt(words);
    EXPECT_TRUE(is_clean(run.out)) << words << run.out;
    EXPECT_TRUE(is_clean(run.err)) << words << run.err;
    EXPECT_THAT(run.out + run.err, HasSubstr("\\u001b")) << words;
  }
  const Outcome json = kinetix_opt("check --json " + broken);
  EXPECT_EQ(nlohmann::json::parse(json.out)["error"]["exit_code"], 2);
  const Outcome valid =
      kinetix_opt("check --json " + ("'" + scratch.write("v\033\x7f.yaml", block_panel) + "'"));
  EXPECT_EQ(nlohmann::json::parse(valid.out)["file"], (scratch / "v\033\x7f.yaml").string());
}

TEST(FileNames, WithLineEndsAreStillOneLine) {
  const Outcome run = kinetix_opt("check \"$(printf 'a\\nb: error')\"");
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.err, "a\\nb: error: no such file\n");
}

TEST(PrintableText, KeepsWordsAndNothingThatATerminalObeys) {
  EXPECT_EQ(app::printable("a b\tc\n"), "a b\tc\n");
  EXPECT_EQ(app::printable("\xc3\x84\xe2\x82\xac\xf0\x9f\x98\x80"), "\xc3\x84\xe2\x82\xac\xf0\x9f\x98\x80");
  EXPECT_EQ(app::printable("\033[0m\r\x7f"), "\\u001b[0m\\u000d\\u007f");
  EXPECT_EQ(app::printable("\xc2\x9b"
                           "1m\xc2\xa0"),
            "\\u009b1m\xc2\xa0");
  EXPECT_EQ(app::printable("\xe2\x80\xae|\xe2\x81\xa6"), "\\u202e|\\u2066");
  EXPECT_EQ(app::printable("\x9b|\xff\xc3"), "\\x9b|\\xff\\xc3");
  EXPECT_EQ(app::printable(std::string("a\0b", 3)), "a\\u0000b");
  EXPECT_EQ(app::printable_line("a\nb"), "a\\nb");
}

/// Tests of files that a target names.
class NamedFile : public ::testing::Test {
 protected:
  NamedFile() { fs::create_directory(scratch_ / "targets"); }

  /// Returns the error of `check` for a document in targets/ that names a file.
  std::string says(const std::string& document) {
    const Outcome run = kinetix_opt("check " + scratch_.write("targets/t.yaml", document));
    EXPECT_EQ(run.code, 2) << run.out;
    return run.err;
  }

  static std::string curve(const std::string& points) {
    return "kinetix: 1\ntarget: {kind: curve, points: " + points +
           "}\nstructure: {cells: [6, 1], cell_mm: 10}\n";
  }

  Scratch scratch_;
};

TEST_F(NamedFile, IsNotQuotedOutsideOfTheFolderOfTheTarget) {
  const std::string secret = "root:secret:0:0\n";
  scratch_.write("passwords", secret);
  scratch_.write("targets/passwords", secret);
  fs::create_directory(scratch_ / "targets/inner");
  scratch_.write("targets/inner/passwords", secret);
  fs::create_symlink(scratch_ / "passwords", scratch_ / "targets/link");
  const std::string inside = "`root:secret:0:0` is not a point or a header";
  EXPECT_THAT(says(curve("passwords")), HasSubstr(inside));
  EXPECT_THAT(says(curve("inner/passwords")), HasSubstr(inside));
  EXPECT_THAT(says(curve("../targets/passwords")), HasSubstr(inside));
  for (const std::string& outside : {std::string("../passwords"), (scratch_ / "passwords").string(),
                                     std::string("link"), std::string("inner/../../passwords")}) {
    const std::string words = says(curve(outside));
    EXPECT_THAT(words, Not(HasSubstr("secret")));
    EXPECT_THAT(words, HasSubstr("not quoted"));
    EXPECT_THAT(words, HasSubstr("with the header `x,z`"));
  }
}

TEST_F(NamedFile, IsNotQuotedWhateverKindItIsReadAs) {
  scratch_.write("a.csv", "secret,z\n1,2\n");
  scratch_.write("b.csv", "x,z\n1,secret\n");
  scratch_.write("a.obj", "v 1 secret 3\nf 1 2 3\n");
  scratch_.write("b.obj", "v 1 2 3\nf 1 secret 3\n");
  scratch_.write("a.stl", "solid a\nfacet secret\n" + std::string(84, ' '));
  scratch_.write("a.ply", "ply\nformat ascii 1.0\nsecret 3\nend_header\n");
  scratch_.write("a.svg",
                 "<svg width='2mm' viewBox='0 0 1 1'><path d='M 0 0 L 1 1' transform='secret(1)'/></svg>");
  scratch_.write("b.svg", "<svg width='2mm' height='2mm' viewBox='0 0 1 1'><path d='M secret'/></svg>");
  std::string fold = text_of(KINETIX_SOURCE "/targets/shapes/miura.fold");
  scratch_.write("a.fold", fold.insert(fold.rfind('}'), ", \"frame_unit\": \"secret\""));
  scratch_.write("a.yaml", "kinetix: 1\nstructure: {cells: [2, 1], lattice: secret}\n");
  const auto graph = [](const char* key, const std::string& file) {
    return fmt::format("kinetix: 1\nstructure: {{lattice: graph, {}: {}}}\ndesign: {{theta_deg: 20}}\n", key,
                       file);
  };
  const auto surface = [](const std::string& file) {
    return "kinetix: 1\ntarget: {kind: surface, mesh: " + file +
           "}\nstructure: {wall_mm: {thickness: 0.8, height: 4}}\n";
  };
  const auto helmet = [](const std::string& file) {
    return "kinetix: 1\ntarget: {kind: helmet, mesh: " + file + "}\nstructure: {cell_mm: 10}\n";
  };
  const auto sweep = [](const std::string& file) {
    return "kinetix: 1\nbase: " + file +
           "\nmethod: {kind: factorial}\nfactors:\n  - {path: design.theta_deg, range: [5, 40]}\nresponses: "
           "[end_mm]\n";
  };
  const std::pair<const char*, std::function<std::string(const std::string&)>> kinds[] = {
      {"a.csv", curve},
      {"b.csv", curve},
      {"a.obj", surface},
      {"b.obj", helmet},
      {"a.stl", surface},
      {"a.ply", helmet},
      {"a.svg", [&](const std::string& file) { return graph("drawing", file); }},
      {"b.svg", [&](const std::string& file) { return graph("drawing", file); }},
      {"a.fold", [&](const std::string& file) { return graph("origami", file); }},
      {"a.yaml", sweep}};
  for (const auto& [name, document] : kinds) {
    fs::copy_file(scratch_ / name, scratch_ / (std::string("targets/") + name));
    EXPECT_THAT(says(document(name)), HasSubstr("secret")) << name;
    EXPECT_THAT(says(document(std::string("../") + name)), Not(HasSubstr("secret"))) << name;
  }
}

}  // namespace
}  // namespace kinetix::testing
