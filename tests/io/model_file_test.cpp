#include "io/scene/model_file.h"

#include <cstdio>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"

namespace walktrack {
namespace {

using testing::HasSubstr;

class ModelFile : public testing::Test {
 protected:
  std::string write(const std::string& text) {
    const std::string path = testing::TempDir() + "model_file_test.yaml";
    std::ofstream(path) << text;
    return path;
  }
  std::string complaint(const std::string& model, const std::string& text,
                        const std::vector<std::string>& settings = {}) {
    try {
      read_model(model, text.empty() ? "" : write(text), settings);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(ModelFile, FileThenSettingsOnTopOfTheDefaults) {
  const ModelSpec spec =
      read_model("",
                 write("model: kneed\nparameters: {slope: 0.1, torso: {mass: 40}}\n"
                       "style: {may_fly: true}\nstart: {q: [1, 2, 3, 4, 5]}\n"),
                 {"controls.hip.stiffness=7", "slope=0.2", "start.qd=[0,0,0,0,1]"});
  EXPECT_EQ(spec.kneed.torso.mass, 40);
  EXPECT_EQ(spec.kneed.slope, 0.2);
  EXPECT_EQ(spec.controls.hip.stiffness, 7);
  EXPECT_TRUE(spec.style.may_fly);
  EXPECT_EQ(spec.start.q, (std::vector<double>{1, 2, 3, 4, 5}));
  EXPECT_EQ(spec.start.qd.back(), 1);
  EXPECT_EQ(spec.kneed.thigh.mass, default_model("kneed").kneed.thigh.mass);
}

TEST_F(ModelFile, EveryModelWritesAFileThatReadsBackTheSame) {
  for (const std::string& name : model_names()) {
    ModelSpec spec = default_model(name);
    spec.start.q.back() = 0.1234567890123;
    const std::string text = model_as_yaml(spec);
    EXPECT_EQ(model_as_yaml(read_model("", write(text), {})), text) << name;
  }
}

TEST_F(ModelFile, ErrorsNamePlaceValueAndWhatIsAllowed) {
  EXPECT_THAT(complaint("", "model: kned\n"), HasSubstr("'kned'"));
  EXPECT_THAT(complaint("", ""), HasSubstr("--model"));
  EXPECT_THAT(complaint("monopode", "model: kneed\n"), HasSubstr("'monopode'"));
  EXPECT_THAT(complaint("", "model: kneed\n\nparameters: {slop: 1}\n"),
              HasSubstr(":3: parameters.slop: found an unknown key, did you mean"));
  EXPECT_THAT(complaint("kneed", "parameters: {slope: steep}\n"), HasSubstr("'steep'"));
  EXPECT_THAT(complaint("kneed", "", {"parameters.thigh.mass=-1"}), HasSubstr("'-1'"));
  EXPECT_THAT(complaint("kneed", "", {"start.q=1,x"}), HasSubstr("numbers with commas"));
  EXPECT_THAT(complaint("kneed", "", {"style.latched=maybe"}), HasSubstr("true or false"));
  EXPECT_THAT(complaint("kneed", "", {"slope"}), HasSubstr("KEY=VALUE"));
}

TEST_F(ModelFile, TheStartMustFitTheModel) {
  ModelSpec spec = default_model("anthropomorphic");
  spec.start.q = {1, 2, 3};
  EXPECT_THROW(start_point(spec, *make_walker(spec)), UsageError);
  ModelSpec monopode = default_model("monopode");
  monopode.start.energy = 1;  // less than standing at the apex
  EXPECT_THROW(start_point(monopode, *make_walker(monopode)), UsageError);
}

}  // namespace
}  // namespace walktrack
