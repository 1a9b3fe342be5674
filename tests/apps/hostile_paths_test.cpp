// Unusual file names, and links in output folders: nothing is written outside the output folder,
// and names are escaped wherever they are printed.
#include <filesystem>
#include <map>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/data_folders.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class HostilePaths : public testing::Test {
 protected:
  HostilePaths() {
    const std::string options = folder_.write("walk.yaml",
                                              "frame_rate: 10\nduration: 0.3\ninitial: true\n"
                                              "background_frames: 2\n"
                                              "walk: {speed: 1.2, start: [-0.2, 0]}\n"
                                              "cameras: [{name: side, azimuth_deg: -90, "
                                              "distance: 4, size: [64, 48]}]\n");
    const ProgramResult render =
        run_walktrack({"render", "--options", options, "-o", folder_ / "walk"});
    if (render.exit_code != 0) throw std::runtime_error(render.err);
  }
  void add(const std::string& name) const {
    const fs::path to = folder_.path() / "in" / name;
    fs::create_directories(to);
    fs::copy(folder_ / "walk", to, fs::copy_options::recursive);
  }
  ProgramResult batch(const std::string& in, const std::string& out) const {
    return run_walktrack({"batch", in, "-o", out, "--threads", "1", "--set", "filter.particles=5",
                          "--set", "start.particles=5", "-c", kAnyQuality});
  }
  // Every file below the folder, except for the output folder, with its content.
  std::map<std::string, std::string> outside() const {
    std::map<std::string, std::string> found;
    for (auto entry = fs::recursive_directory_iterator(folder_.path()); entry != fs::end(entry);
         ++entry) {
      if (entry->path() == folder_.path() / "out") {
        entry.disable_recursion_pending();
      } else if (entry->is_regular_file()) {
        found[entry->path()] = read_file(entry->path());
      }
    }
    return found;
  }

  TemporaryFolder folder_;
};

TEST_F(HostilePaths, NamesAreDataWhateverTheyHold) {
  const std::vector<std::string> names{"a b",
                                       "line\nbreak",
                                       "\xC3\xBC"
                                       "ber \xE2\x80\xAE\xE6\xBC\xA2",
                                       "<b>&\"'",
                                       "$(touch x);`y`|*",
                                       "-rf",
                                       "\xFF\xFE",
                                       "..."};
  for (const std::string& name : names) add(name);
  const auto before = outside();
  const ProgramResult run = batch(folder_ / "in", folder_ / "out");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const std::string& name : names)
    EXPECT_TRUE(fs::exists(folder_.path() / "out" / name / "joints.csv")) << name;
  EXPECT_EQ(outside(), before);
  const std::string page = read_file(folder_ / "out/batch.html");
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;&amp;&quot;"));
  EXPECT_THAT(page, Not(HasSubstr("<b>&")));
  EXPECT_THAT(page, HasSubstr("href=\"line%0Abreak/report.html\""));
  const std::string table = read_file(folder_ / "out/summary.csv");
  EXPECT_THAT(table, HasSubstr("\n\"line\nbreak\",complete,"));
  EXPECT_THAT(table, HasSubstr("\n\"<b>&\"\"'\",complete,"));
  const std::string report = read_file(folder_ / "out/<b>&\"'/report.html");
  EXPECT_THAT(report, HasSubstr("<title>&lt;b&gt;&amp;&quot;"));
}

// A scene may refer to inputs anywhere; everything that is written stays in the output folder.
TEST_F(HostilePaths, DotsAndLinksOfScenesLeadNoResultAstray) {
  const std::string scene = read_file(folder_ / "walk/scene.yaml");
  std::string up = scene;
  up.replace(up.find("side.mp4"), 8, "../../walk/side.mp4");
  folder_.write("in/up/scene.yaml", up);
  for (const char* file : {"side.yaml", "side_background.mp4", "truth.csv"})
    fs::create_symlink(folder_.path() / "walk" / file, folder_.path() / "in/up" / file);
  fs::create_directory(folder_.path() / "in/link");
  fs::create_symlink(folder_.path() / "walk/scene.yaml", folder_.path() / "in/link/scene.yaml");
  const auto before = outside();
  const ProgramResult run = batch(folder_ / "in/../in/.", folder_ / "in/../out/x/..");
  EXPECT_TRUE(fs::exists(folder_ / "out/up/joints.csv")) << run.err;
  EXPECT_EQ(outside(), before);
}

TEST_F(HostilePaths, LinksInTheOutputAreRefusedAndNotFollowed) {
  add("s");
  const std::string target = folder_.write("mine.txt", "mine");
  for (const char* file :
       {"s/joints.csv", "s/uncertainty.csv", "s/log.txt", "s/failure.txt", "s/frames.bin",
        "s/checkpoint.bin", "s/run.partial.json", "s/overlay_side.mp4", "s/report.html",
        "s/kinetics.csv", "summary.csv", "failures.txt", "batch.html"}) {
    const fs::path link = folder_.path() / "out" / file;
    fs::create_directories(folder_.path() / "out/s");
    fs::create_symlink(target, link);
    const ProgramResult run = batch(folder_ / "in", folder_ / "out");
    // A link at a file of the batch itself stops it; any other link fails one sequence.
    EXPECT_THAT(run.err, HasSubstr(std::string(file) + ": found a file that 'walktrack "));
    EXPECT_NE(run.exit_code, 0);
    EXPECT_EQ(read_file(target), "mine");
    EXPECT_TRUE(fs::is_symlink(link)) << file;
    fs::remove_all(folder_.path() / "out");
  }
  EXPECT_EQ(batch(folder_ / "in", folder_ / "out").exit_code, 0);
}

TEST_F(HostilePaths, AFolderThatLeadsElsewhereIsRefused) {
  add("deep/s");
  folder_.write("elsewhere/joints.csv", "mine");
  fs::create_directories(folder_.path() / "out");
  fs::create_directory_symlink(folder_.path() / "elsewhere", folder_.path() / "out/deep");
  const auto before = outside();
  const ProgramResult run = batch(folder_ / "in", folder_ / "out");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("out/deep: found a link, allowed: a folder of the batch's own"));
  EXPECT_EQ(outside(), before);
}

}  // namespace
}  // namespace walktrack
