#include "io/scene/subject_file.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/sample_files.h"
#include "tests/message_of.h"

namespace walktrack {
namespace {

using testing::HasSubstr;
using testing::Not;

YamlValue yaml(const std::string& text) {
  return YamlValue::from_text(text, "scene.yaml").at("subject");
}

class SubjectFile : public testing::Test {
 protected:
  StatedSubject read(const std::string& text) { return read_subject(yaml(text), folder_.path()); }
  std::string error_of(const std::string& text) {
    return message_of([&] { read(text); });
  }
  TemporaryFolder folder_;
};

TEST_F(SubjectFile, AFileStatesWhatAMapStates) {
  const std::string map =
      "{height: 1.612, height_sd: 0.03, mass: 55, girth: 1.2, lengths: {thigh: 0.41, forearm: "
      "0.25}}";
  folder_.write("anna.yaml", map);
  const StatedSubject inside = read("subject: " + map), apart = read("subject: anna.yaml");
  EXPECT_EQ(apart.file, folder_.path() / "anna.yaml");
  EXPECT_TRUE(inside.file.empty());
  for (const StatedSubject& each : {inside, apart}) {
    EXPECT_EQ(each.subject.height, 1.612);
    EXPECT_EQ(each.height_sd, 0.03);
    EXPECT_EQ(each.subject.mass, 55);
    EXPECT_EQ(each.subject.lengths.thigh, 0.41);
    EXPECT_EQ(each.subject.lengths.forearm, 0.25);
    EXPECT_FALSE(each.subject.lengths.shank);
    EXPECT_EQ(each.subject.girth, 1.2);
    EXPECT_TRUE(each.height_stated && each.mass_stated && each.girth_stated);
  }
}

TEST_F(SubjectFile, WhatIsWrittenIsReadAgain) {
  StatedSubject stated;
  stated.subject.height = 1.8;
  stated.subject.lengths.trunk = 0.52;
  stated.subject.lengths.ankle_height = 0.07;
  stated.height_stated = true;
  stated.height_sd = 0.024;
  folder_.write("subject.yaml", subject_text(stated));
  const StatedSubject again = read("subject: subject.yaml");
  EXPECT_EQ(again.subject.height, 1.8);
  EXPECT_EQ(again.height_sd, 0.024);
  EXPECT_EQ(again.subject.lengths.trunk, 0.52);
  EXPECT_EQ(again.subject.lengths.ankle_height, 0.07);
  EXPECT_FALSE(again.subject.lengths.thigh);
  EXPECT_FALSE(again.mass_stated);
  EXPECT_EQ(again.subject.mass, Subject{}.mass);
  EXPECT_THAT(subject_text(stated), Not(HasSubstr("mass")));
  EXPECT_FALSE(again.girth_stated);
  stated.girth_stated = true;
  stated.subject.girth = 1.32;
  folder_.write("subject.yaml", subject_text(stated));
  EXPECT_EQ(read("subject: subject.yaml").subject.girth, 1.32);
}

TEST_F(SubjectFile, NamesTheFileAndTheMistake) {
  folder_.write("bad.yaml", "height: 1.7\nweight: 60\n");
  const std::string bad = error_of("subject: bad.yaml");
  EXPECT_THAT(bad, HasSubstr("bad.yaml:2: weight: found an unknown key"));
  EXPECT_THAT(error_of("subject: nobody.yaml"), HasSubstr("subject: found 'nobody.yaml'"));
  EXPECT_THAT(error_of("subject: ."), HasSubstr("subject: found '.'"));
  EXPECT_THAT(error_of("subject: {height_sd: 0.1}"), HasSubstr("height_sd: found no 'height'"));
  EXPECT_THAT(error_of("subject: {height: 1.7, height_sd: 0}"),
              HasSubstr("height_sd: found '0', allowed: a number from 0.001 to 0.5"));
  EXPECT_THAT(error_of("subject: {girth: 130}"),
              HasSubstr("girth: found '130', allowed: a number from 0.5 to 2"));
}

}  // namespace
}  // namespace walktrack
