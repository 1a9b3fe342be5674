#include "jobs/track/results/motion_tables.h"

#include <filesystem>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/archive/files.h"
#include "io/tables/csv.h"
#include "io/tables/motion_file.h"
#include "kinetics/gait_contacts.h"
#include "tests/data_folders.h"
#include "tests/io/bvh_reader.h"
#include "tests/io/c3d_reader.h"
#include "tests/io/glb_reader.h"
#include "tests/io/opensim_reader.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

TEST(FootContacts, AStanceCutByTheEndLastsAsLongAsDoubleSupportElsewhere) {
  Gait gait;
  gait.stances = {{Side::kLeft, 0.0, 0.7, false, true, {}},
                  {Side::kRight, 0.55, 1.3, true, true, {}},
                  {Side::kLeft, 1.1, 1.9, true, false, {}},
                  {Side::kRight, 1.6, 1.9, true, false, {}}};
  const auto contacts = foot_contacts(gait);
  ASSERT_EQ(contacts.size(), 4u);
  EXPECT_NEAR(contacts[2].off, 1.6 + 0.5 * (0.15 + 0.2), 1e-12);
  EXPECT_EQ(contacts[3].off, 1.9);
  EXPECT_EQ(contacts[0].on, 0.0);
}

TEST(FootContacts, AStanceCutByTheStartBeganBeforeTheOtherFootLeft) {
  Gait gait;
  gait.stances = {{Side::kLeft, 0.0, 0.3, false, true, {}},
                  {Side::kRight, 0.0, 0.8, false, true, {}}};
  const auto contacts = foot_contacts(gait);
  EXPECT_NEAR(contacts[1].on, 0.3 - 0.12, 1e-12);
  EXPECT_EQ(contacts[0].on, 0.0);
}

class MotionTables : public testing::Test {
 protected:
  void write(const AnalysedMotion& analysed) {
    totals_ = write_motion_tables(analysed, {},
                                  ResultFolder({folder_, "test", motion_table_files()}, true))
                  .forces;
  }
  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path() / "tables";
  KineticsTotals totals_;
};

// The demo's truth: 1.25 m/s of a 70 kg subject with steps that are known by construction.
TEST_F(MotionTables, OfTheDemoSayWhatTheDemoIs) {
  AnalysedMotion demo;
  demo.motion = read_motion(kDemo / "truth.csv");
  demo.members = ensemble_of({demo.motion, demo.motion, demo.motion});
  write(demo);
  const auto gait = nlohmann::json::parse(read_text_file(folder_ / "gait.json", size_t{1} << 20));
  const auto& both = gait.at("summary").at("both");
  EXPECT_NEAR(both.at("speed_m_s").at("value").get<double>(), 1.25, 0.05);
  // Three equal members give no uncertainty, and the model's error was not stated.
  EXPECT_EQ(both["step_time_s"]["p05"], both["step_time_s"]["p95"]);
  EXPECT_TRUE(fs::exists(folder_ / "gait.csv"));
  const CsvTable table = read_csv(folder_ / "kinetics.csv");
  EXPECT_EQ(table.rows.size(), demo.motion.time.size());
  double load = 0, rows = 0;
  for (const CsvTable::Row& row : table.rows) {
    load +=
        table.number(row, table.column("l_grf_z_n")) + table.number(row, table.column("r_grf_z_n"));
    ++rows;
  }
  // Over several strides the ground carries the weight, except for the incomplete last step.
  EXPECT_NEAR(load / rows, demo.subject.mass * 9.80665, 0.03 * demo.subject.mass * 9.80665);
  EXPECT_GT(totals_.peak_load, 1);
  EXPECT_LT(totals_.peak_load, 2);
  EXPECT_GT(totals_.cost_of_transport, 0.02);
  EXPECT_LT(totals_.cost_of_transport, 0.5);
}

// In OpenSim the model's joints are at the joints and the forces act on its feet.
TEST_F(MotionTables, OpenSimShowsFeetOnTheGroundAndForcesAtThem) {
  AnalysedMotion demo;
  demo.motion = read_motion(kDemo / "truth.csv");
  const BodyLengths lengths = body_lengths(demo.subject);
  demo.angles = angle_rows(demo.motion, lengths);
  write(demo);
  const auto text = [&](const char* name) { return read_text_file(folder_ / name, 1u << 24); };
  const Markers markers = read_trc(text("joints.trc"));
  const Storage angles = read_storage(text("angles.mot")),
                forces = read_storage(text("ground_reaction.mot"));
  read_storage(text("joint_moments.sto"));
  ASSERT_EQ(angles.rows.size(), markers.rows.size());
  std::map<double, std::map<std::string, Eigen::Vector3d>> model;
  for (size_t i = 0; i < angles.rows.size(); ++i) {
    const auto joints = opensim_joints(angles.row(i), lengths);
    for (size_t k = 0; k < markers.names.size(); ++k)
      if (const auto joint = joints.find(markers.names[k]); joint != joints.end()) {
        EXPECT_LT((joint->second - markers.rows[i][k]).norm(), 0.01) << joint->first << " in " << i;
      }
    model[angles.rows[i][0]] = joints;
  }
  int loaded = 0;
  for (size_t i = 0; i < forces.rows.size(); ++i) {
    const auto row = forces.row(i);
    for (const std::string side : {"l", "r"}) {
      if (row.at("ground_force_" + side + "_vy") < 50) continue;
      const auto centre = [&](const char* axis) {
        return row.at("ground_force_" + side + "_p" + axis);
      };
      EXPECT_EQ(centre("y"), 0);
      const auto& joints = model.at(row.at("time"));
      const Eigen::Vector3d middle = 0.5 * (joints.at(side + "ankle") + joints.at(side + "toe"));
      const Eigen::Vector2d away(centre("x") - middle.x(), centre("z") - middle.z());
      EXPECT_LT(away.norm(), 0.6 * lengths.foot + 0.05)
          << "the sole, and five centimetres beside it";
      ++loaded;
    }
  }
  EXPECT_GT(loaded, 20);
}

// In a laboratory's viewer joints, angles and events are those of the tables, and the plates carry
// the person below the feet.
TEST_F(MotionTables, LaboratoriesSeeTheSameWalk) {
  AnalysedMotion demo;
  demo.motion = read_motion(kDemo / "truth.csv");
  demo.angles = angle_rows(demo.motion, body_lengths(demo.subject));
  write(demo);
  const ReadC3d file = read_c3d(read_text_file(folder_ / "joints.c3d", 1u << 24));
  EXPECT_EQ(file.rate, 30);
  ASSERT_EQ(file.frames.size(), demo.motion.time.size());
  const auto& labels = file.at("POINT:LABELS").texts;
  const auto point = [&](const std::string& name, size_t frame) {
    const auto at = std::find(labels.begin(), labels.end(), name) - labels.begin();
    return file.frames.at(frame).at(static_cast<size_t>(at)).at;
  };
  const CsvTable angles = read_csv(folder_ / "angles.csv");
  for (const size_t frame : {5u, 40u}) {
    EXPECT_LT(
        (point("rankle", frame) - 1000 * demo.motion.joints[frame][Joint::kRightAnkle]).norm(),
        0.01);
    EXPECT_NEAR(point("RKneeAngles", frame).x(),
                angles.number(angles.rows[frame], angles.column("knee_angle_r_deg")), 1e-3);
  }
  const auto gait = nlohmann::json::parse(read_text_file(folder_ / "gait.json", 1u << 20));
  const auto contexts = file.all_texts("EVENT:CONTEXTS"), kinds = file.all_texts("EVENT:LABELS");
  const auto times = file.all_numbers("EVENT:TIMES");
  ASSERT_EQ(contexts.size(), gait.at("events").size());
  ASSERT_GT(contexts.size(), 8u);
  for (size_t i = 0; i < contexts.size(); ++i) {
    const auto& event = gait.at("events")[i];
    EXPECT_EQ(contexts[i], event.at("side") == "left" ? "Left" : "Right");
    EXPECT_EQ(kinds[i], event.at("event") == "toe_off" ? "Foot Off" : "Foot Strike");
    EXPECT_NEAR(times[2 * i + 1], event.at("time_s").at("value").get<double>(), 1e-3);
  }
  int loaded = 0;
  for (size_t frame = 0; frame < file.frames.size(); ++frame)
    for (const size_t plate : {0u, 1u}) {
      const PlateReading reading = read_plate(file, plate, frame);
      if (!(reading.force.z() > 50)) continue;
      const std::string side = plate == 0 ? "l" : "r";
      const Eigen::Vector3d middle =
          0.5 * (point(side + "ankle", frame) + point(side + "toe", frame));
      EXPECT_LT((reading.centre - middle).head<2>().norm(), 220) << side << " in " << frame;
      ++loaded;
    }
  EXPECT_GT(loaded, 100);
}

// In Blender every joint is at its place in joints.csv, to less than a millimetre.
TEST_F(MotionTables, FiguresMoveAsTheJointsDo) {
  AnalysedMotion demo;
  demo.motion = read_motion(kDemo / "truth.csv");
  demo.motion.joints[7] = unknown_joints();
  write(demo);
  const ReadBvh bvh = read_bvh(read_text_file(folder_ / "figure.bvh", 1u << 24));
  const std::string bytes = read_text_file(folder_ / "figure.glb", 1u << 24);
  const ReadGlb glb(bytes);
  ASSERT_EQ(bvh.frames.size(), demo.motion.time.size());
  EXPECT_EQ(bvh.frames[7], bvh.frames[6]);
  for (size_t row = 0; row < bvh.frames.size(); ++row) {
    const auto places = bvh.places(row);
    const GlbPose pose = glb.at(demo.motion.time[row] + 1e-6);
    if (row == 7) {
      EXPECT_EQ(pose.nodes.at("head").linear().norm(), 0);
      continue;
    }
    for (const Joint joint : {Joint::kPelvis, Joint::kNeck, Joint::kLeftHip, Joint::kRightKnee,
                              Joint::kLeftAnkle, Joint::kRightElbow}) {
      const std::string name(kJointNames[static_cast<size_t>(joint)]);
      const Eigen::Vector3d& at = demo.motion.joints[row][joint];
      const Eigen::Vector3d there(at.x(), at.z(), -at.y());
      EXPECT_LT((places.at(name) - there).norm(), 1e-3) << name << " in " << row;
      EXPECT_LT((pose.place(name) - there).norm(), 1e-3) << name << " in " << row;
    }
  }
}

// Spreadsheets and pandas use the first line as the header.
TEST_F(MotionTables, BeginWithTheirHeaderAndAreExplainedBesideThem) {
  AnalysedMotion demo;
  demo.motion = read_motion(kDemo / "truth.csv");
  demo.angles = angle_rows(demo.motion, body_lengths(demo.subject));
  demo.rate = 30;
  write(demo);
  const auto notes = nlohmann::json::parse(read_text_file(folder_ / "tables.json", 1u << 20));
  for (const char* name : {"angles.csv", "gait.csv", "kinetics.csv"}) {
    const CsvTable table = read_csv(folder_ / name);
    EXPECT_EQ(table.header_line, 1) << name;
    EXPECT_TRUE(notes.at(name).contains("units")) << name;
  }
  EXPECT_EQ(notes["angles.csv"]["rate_hz"], 30);
  EXPECT_EQ(notes["kinetics.csv"]["subject"]["mass_kg"], demo.subject.mass);
  EXPECT_GT(notes["kinetics.csv"]["totals"]["positive_work_j"].get<double>(), 10);
}

// A loaded foot's vertical force has a wider band than that of its members, other forces do not.
TEST_F(MotionTables, BandsHoldTheModelsErrorOfLoads) {
  AnalysedMotion demo;
  demo.motion = read_motion(kDemo / "truth.csv");
  demo.members = ensemble_of({demo.motion, demo.motion, demo.motion});
  demo.model_error = 1;
  write(demo);
  const CsvTable table = read_csv(folder_ / "kinetics.csv");
  const auto half = [&](const CsvTable::Row& row, const std::string& name) {
    return 0.5 * (table.number(row, table.column(name + "_p95")) -
                  table.number(row, table.column(name + "_p05")));
  };
  const double expected = 1.645 * kTrackedLoadError * demo.subject.mass * 9.80665;
  size_t loaded = 0, swinging = 0;
  for (const CsvTable::Row& row : table.rows) {
    const bool stands = table.number(row, table.column("l_grf_z_n")) > 0;
    EXPECT_NEAR(half(row, "l_grf_z_n"), stands ? expected : 0, 1e-3);
    EXPECT_NEAR(half(row, "l_grf_x_n"), 0, 1e-3);
    ++(stands ? loaded : swinging);
  }
  EXPECT_GT(loaded, 50u);
  EXPECT_GT(swinging, 20u);
}

}  // namespace
}  // namespace walktrack
