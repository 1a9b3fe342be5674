#include "io/archive/result_folder.h"

#include <array>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "tests/message_of.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ResultFolders : public testing::Test {
 protected:
  Outputs outputs(std::vector<std::string> files = {"joints.csv", "report.html"}) const {
    return {folder_.path() / "out", "track", std::move(files)};
  }
  std::string refusal(const Outputs& of, bool overwrite = true) const {
    return message_of<UsageError>([&] { ResultFolder(of, overwrite); });
  }
  // All files below the folder with their content.
  std::map<std::string, std::string> content() const {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
      if (entry.is_regular_file()) found[entry.path()] = read_file(entry.path());
    return found;
  }
  void expect_refused(const Outputs& of, const std::string& words) const {
    const auto before = content();
    EXPECT_THAT(refusal(of), HasSubstr(words));
    EXPECT_EQ(content(), before);
  }
  std::string write(const std::string& name) const { return folder_.write("out/" + name, "mine"); }
  bool there(const std::string& name) const { return fs::exists(folder_.path() / "out" / name); }

  const TemporaryFolder folder_;
};

TEST_F(ResultFolders, AreCompleteOnlyAfterFinish) {
  Outputs deep = outputs();
  deep.folder /= "a/b";
  const ResultFolder result(deep, false);
  result.write("joints.csv", "t\n");
  EXPECT_FALSE(is_complete_result(deep.folder));
  result.finish("{}");
  EXPECT_TRUE(is_complete_result(deep.folder));
  EXPECT_EQ(read_file(deep.folder / "joints.csv"), "t\n");
}

TEST_F(ResultFolders, CompleteOnesAreRefusedUnlessTold) {
  ResultFolder(outputs(), false).finish("{}");
  EXPECT_THAT(refusal(outputs(), false), HasSubstr("holds a complete result; -y overwrites it"));
  EXPECT_TRUE(is_complete_result(outputs().folder));
  const ResultFolder again(outputs(), true);
  EXPECT_FALSE(is_complete_result(outputs().folder));
}

TEST_F(ResultFolders, TakeTheFileThatIsWrittenLast) {
  Outputs scene = outputs({"side.mp4", "scene.yaml"});
  scene.last = "scene.yaml";
  ResultFolder(scene, false).write("scene.yaml", "");
  EXPECT_THAT(refusal(scene, false), HasSubstr("scene.yaml exists; -y overwrites it"));
  EXPECT_EQ(refusal(scene, true), "");
  scene.last = "";
  ResultFolder(scene, false).write("scene.yaml", "");
  EXPECT_EQ(refusal(scene, false), "");
}

// Files of a killed run, including incomplete ones, are known from the marker, which was written
// before them.
TEST_F(ResultFolders, ClearWhatAKilledRunLeftAndNothingElse) {
  {
    const ResultFolder killed(outputs({"joints.csv", "overlay_a.mp4"}), false);
    EXPECT_THAT(read_file(outputs().folder / ".walktrack_track"), HasSubstr("\njoints.csv\n"));
    killed.write("joints.csv", "");
    new_temporary(killed.file("joints.csv"));
    new_temporary(killed.file("overlay_a.mp4"), ".mp4");
    new_temporary(outputs().folder / ".walktrack_track");
  }
  for (const char* name :
       {"notes.tmp", "a..tmp", "mine.csv", "mine.csv.71.tmp", "thesis.7.tmp.mp4"})
    write(name);
  const ResultFolder again(outputs(), false);
  EXPECT_EQ(std::distance(fs::directory_iterator(outputs().folder), fs::directory_iterator()), 6);
  EXPECT_FALSE(there("joints.csv"));
}

TEST_F(ResultFolders, KeepWhatTheyAreToldTo) {
  constexpr std::array<std::string_view, 1> kKept{"joints.csv"};
  ResultFolder(outputs(), false).write("joints.csv", "kept");
  ResultFolder(outputs(), false, kKept);
  EXPECT_TRUE(there("joints.csv"));
  ResultFolder(outputs(), false);
  EXPECT_FALSE(there("joints.csv"));
}

TEST_F(ResultFolders, OfPartialResultsMayBeDoneAgain) {
  ResultFolder(outputs(), false).finish_partial("{}");
  EXPECT_TRUE(there("run.partial.json"));
  ResultFolder(outputs(), false).finish("{}");
  EXPECT_TRUE(is_complete_result(outputs().folder));
  EXPECT_FALSE(there("run.partial.json"));
}

// Files with the command's names that no marker lists, of any kind.
TEST_F(ResultFolders, RefuseFilesThatAreNotTheirs) {
  for (const char* name : {"joints.csv", "report.html", "run.json", "run.partial.json"}) {
    write(name);
    expect_refused(outputs(), std::string(name) + ": found a file that 'walktrack track' has not");
    fs::remove(outputs().folder / name);
  }
  fs::create_symlink(folder_ / "nowhere", outputs().folder / "joints.csv");
  expect_refused(outputs(), "joints.csv: found a file");
  fs::remove(outputs().folder / "joints.csv");
  fs::create_directory(outputs().folder / "joints.csv");
  expect_refused(outputs(), "joints.csv: found a file");
}

TEST_F(ResultFolders, RefuseFilesThatAnotherCommandWrote) {
  Outputs other = outputs();
  other.command = "analyse";
  ResultFolder(other, false).finish("{}");
  expect_refused(outputs(),
                 "run.json: found a file that 'walktrack track' has not marked as its own");
}

// A folder of an earlier track: files that were added later are not the program's.
TEST_F(ResultFolders, RefuseWhatCameLater) {
  ResultFolder(outputs({"joints.csv"}), false).finish("{}");
  write("report.html");
  expect_refused(outputs(), "report.html: found a file");
  ResultFolder(outputs({"joints.csv"}), true);
  EXPECT_TRUE(there("report.html"));
}

TEST_F(ResultFolders, RefuseAFolderWithAnInput) {
  Outputs of = outputs();
  for (const char* name : {"side.mp4", "frames/%05d.png", "frames/00001.png"}) {
    of.inputs = {folder_.path() / "in", write(name)};
    if (std::string(name).starts_with("frames")) of.folder = outputs().folder / "frames";
    expect_refused(of, "which the command reads, allowed: a folder of the command's own");
  }
  of.inputs = {of.folder};  // a folder of images
  expect_refused(of, "'frames', which the command reads");
  of = outputs();
  fs::create_directory(folder_.path() / "in");
  fs::create_symlink(folder_ / "out/side.mp4", folder_.path() / "in/link.mp4");
  of.inputs = {folder_.path() / "in/link.mp4"};
  expect_refused(of, "which the command reads");
  fs::create_directory_symlink(of.folder, folder_.path() / "alias");
  of.folder = folder_.path() / "alias/../alias";
  of.inputs = {outputs().folder / "side.mp4"};
  expect_refused(of, "which the command reads");
}

TEST_F(ResultFolders, RefuseASceneThatIsNotTheirs) {
  write("scene.yaml");
  expect_refused(outputs(), "out: found a scene, allowed: a folder of the command's own");
  Outputs scene = outputs({"scene.yaml"});
  expect_refused(scene, "found a scene");
  fs::remove(outputs().folder / "scene.yaml");
  ResultFolder(scene, false).write("scene.yaml", "");
  EXPECT_EQ(refusal(scene), "");
}

// A batch writes the scene of a video and its command the result into one folder.
TEST_F(ResultFolders, TakeTheSceneThatABatchMade) {
  Outputs batch = outputs({"scene.yaml"});
  batch.command = "batch";
  batch.last = "";
  ResultFolder(batch, true).write("scene.yaml", "");
  Outputs of = outputs();
  of.inputs = {of.folder / "scene.yaml"};
  EXPECT_EQ(refusal(of), "");
  EXPECT_TRUE(there("scene.yaml"));
}

TEST_F(ResultFolders, OfNumberedFiles) {
  const Outputs of = outputs({numbered_files("labels/side", ".png")});
  {
    const ResultFolder result(of, false);
    fs::create_directories(of.folder / "labels/side");
    for (const char* name : {"labels/side/000001.png", "labels/side/1000000.png"})
      result.write(name, "");
    EXPECT_THROW(result.file("labels/side/x.png"), std::logic_error);
  }
  EXPECT_EQ(refusal(of), "");
  EXPECT_FALSE(there("labels"));  // empty folders are removed, too
  for (const char* name : {"labels/side/x.png", "labels/side/deep/x", "labels/x"}) {
    write(name);
    expect_refused(of, ": found a file that 'walktrack track' has not marked as its own");
    fs::remove_all(of.folder / "labels");
  }
  fs::create_directory(folder_.path() / "elsewhere");
  fs::create_directory_symlink(folder_.path() / "elsewhere", of.folder / "labels");
  expect_refused(of, "labels: found a file");
}

TEST_F(ResultFolders, OfNumberedFilesThatBeginWithAWord) {
  const Outputs of = outputs({numbered_files("keypoints", "_k.json", "side_")});
  const ResultFolder result(of, false);
  fs::create_directories(of.folder / "keypoints");
  result.write("keypoints/side_000012_k.json", "");
  EXPECT_THROW(result.file("keypoints/front_000012_k.json"), std::logic_error);
  EXPECT_EQ(refusal(of), "");
  EXPECT_FALSE(there("keypoints"));
}

TEST_F(ResultFolders, WriteNoFileThatTheyHaveNotNamed) {
  const ResultFolder result(outputs(), false);
  EXPECT_THROW(result.file("planted_frames.bin"), std::logic_error);
  EXPECT_THROW(result.write("../joints.csv", ""), std::logic_error);
}

TEST_F(ResultFolders, TakeNamesOfFilesOnly) {
  for (const std::string name : {"", "../x", "a/b", ".hidden", "a\nb", "a\tb"})
    EXPECT_THAT(refusal(outputs({name})), HasSubstr("for the name of a file")) << name;
  EXPECT_THAT(refusal(outputs({"a", "a"})), HasSubstr("two files of this name"));
  EXPECT_FALSE(there(""));
}

TEST_F(ResultFolders, RefuseAFile) {
  Outputs file = outputs();
  file.folder = folder_.write("f", "");
  EXPECT_THAT(refusal(file), HasSubstr("is a file, allowed: a folder"));
}

TEST_F(ResultFolders, InputsOfOneFileAreNotItsOutput) {
  const std::string input = write("truth.csv");
  EXPECT_THROW(refuse_input(outputs().folder / "../out/truth.csv", {"none", input}), UsageError);
  EXPECT_NO_THROW(refuse_input(folder_.path() / "new.svg", {input, ""}));
}

}  // namespace
}  // namespace walktrack
