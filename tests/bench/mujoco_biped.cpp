#include <mujoco/mujoco.h>

#include <array>
#include <cstring>
#include <stdexcept>

#include "tests/bench/peers.h"

namespace walktrack {
namespace {

constexpr char kModel[] = R"(
<mujoco>
  <option><flag contact="disable" constraint="disable"/></option>
  <default>
    <joint type="hinge" axis="0 1 0" stiffness="50" damping="3"/>
    <geom type="capsule" size=".05" contype="0" conaffinity="0"/>
  </default>
  <worldbody>
    <body name="stance_shank">
      <joint stiffness="0"/><geom fromto="0 0 0 0 0 .45" mass="4"/>
      <body name="stance_thigh" pos="0 0 .45">
        <joint/><geom fromto="0 0 0 0 0 .43" mass="7"/>
        <body name="torso" pos="0 0 .43"><joint/><geom fromto="0 0 0 0 0 .5" mass="47"/></body>
        <body name="swing_thigh" pos="0 0 .43">
          <joint/><geom fromto="0 0 0 0 0 -.43" mass="7"/>
          <body name="swing_shank" pos="0 0 -.43"><joint/><geom fromto="0 0 0 0 0 -.45" mass="4"/></body>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>)";

}  // namespace

struct MujocoBiped::World {
  mjModel* model = nullptr;
  mjData* data = nullptr;
};

MujocoBiped::MujocoBiped() : world_(std::make_unique<World>()) {
  constexpr char kName[] = "biped.xml";
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), kName, sizeof(kModel));
  std::memcpy(files->filedata[0], kModel, sizeof(kModel));
  std::array<char, 500> error{};
  world_->model = mj_loadXML(kName, files.get(), error.data(), static_cast<int>(error.size()));
  mj_deleteVFS(files.get());
  if (world_->model == nullptr) throw std::runtime_error(error.data());
  world_->data = mj_makeData(world_->model);
}

MujocoBiped::~MujocoBiped() {
  mj_deleteData(world_->data);
  mj_deleteModel(world_->model);
}

double MujocoBiped::evaluate(const Vector5& q, const Vector5& qd) {
  for (int k = 0; k < 5; ++k) {
    world_->data->qpos[k] = q[k];
    world_->data->qvel[k] = qd[k];
  }
  mj_forward(world_->model, world_->data);
  return world_->data->qacc[0];
}

}  // namespace walktrack
