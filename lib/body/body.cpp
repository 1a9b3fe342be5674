#include "body/body.h"

namespace walktrack {
inline namespace body {

namespace {

// Half widths as shares of the stature (source: body/subject.h). Circular sections come from
// circumferences / 2 pi: thigh .596, knee .386, calf .378, ankle .222, upper arm .325, elbow .270,
// wrist .174, over a stature of 1.756 m. Breadths and depths: waist .309 x .226, hips .342 x .250,
// chest .322 x .243, head .152 x .197.
constexpr CrossSection kHips{.0930, .0680}, kWaist{.0840, .0620}, kChest{.0900, .0680};
constexpr CrossSection kShoulders{.0840, .0480};
constexpr CrossSection kThighTop{.0500, .0520}, kKnee{.0345, .0350};
constexpr CrossSection kCalf{.0325, .0343}, kAnkle{.0205, .0215};
constexpr CrossSection kHeel{.0190, .0190}, kToes{.0270, .0110};
constexpr CrossSection kSkullLow{.0400, .0500}, kSkullHigh{.0420, .0520};
constexpr CrossSection kNeck{.0330, .0340};
constexpr CrossSection kUpperArmTop{.0295, .0295}, kElbow{.0245, .0245}, kWrist{.0158, .0158};

CrossSection scaled(CrossSection share, double size) {
  return {share.lateral * size, share.forward * size};
}

Eigen::Vector3d up(double length) { return {0, 0, length}; }

void add_trunk(Body& body) {
  const double h = body.subject.height;
  const double w = h * body.subject.girth;
  const double waist = .40 * body.lengths.trunk, chest = .78 * body.lengths.trunk;
  body.parts.push_back({Segment::kPelvis, Joint::kPelvis, up(-.010 * h), up(.030 * h),
                        scaled(kHips, w), scaled(kHips, w), Appearance::kLegs});
  body.parts.push_back({Segment::kTrunk, Joint::kPelvis, up(.035 * h), up(waist), scaled(kHips, w),
                        scaled(kWaist, w), Appearance::kTrunk});
  body.parts.push_back({Segment::kTrunk, Joint::kPelvis, up(waist), up(chest), scaled(kWaist, w),
                        scaled(kChest, w), Appearance::kTrunk});
  body.parts.push_back({Segment::kTrunk, Joint::kPelvis, up(chest), up(body.lengths.trunk),
                        scaled(kChest, w), scaled(kShoulders, w), Appearance::kTrunk});
}

void add_head(Body& body) {
  const double h = body.subject.height, centre = body.lengths.head;
  body.parts.push_back({Segment::kTrunk, Joint::kPelvis, up(body.lengths.trunk),
                        up(centre - .03 * h), scaled(kNeck, h), scaled(kNeck, h),
                        Appearance::kHead});
  body.parts.push_back({Segment::kTrunk, Joint::kPelvis, up(centre - .018 * h),
                        up(centre + .020 * h), scaled(kSkullLow, h), scaled(kSkullHigh, h),
                        Appearance::kHead});
}

void add_leg(Body& body, Side side) {
  const double h = body.subject.height;
  const double w = h * body.subject.girth;
  const BodyLengths& l = body.lengths;
  const bool left = side == Side::kLeft;
  const Segment thigh = left ? Segment::kLeftThigh : Segment::kRightThigh;
  const Segment shank = left ? Segment::kLeftShank : Segment::kRightShank;
  const Segment foot = left ? Segment::kLeftFoot : Segment::kRightFoot;
  const double calf = -.30 * l.shank;
  body.parts.push_back({thigh, hip(side), up(-l.thigh), up(0), scaled(kKnee, w),
                        scaled(kThighTop, w), Appearance::kLegs});
  body.parts.push_back(
      {shank, knee(side), up(calf), up(0), scaled(kCalf, w), scaled(kKnee, w), Appearance::kLegs});
  body.parts.push_back({shank, knee(side), up(-l.shank), up(calf), scaled(kAnkle, w),
                        scaled(kCalf, w), Appearance::kLegs});
  const CrossSection heel = scaled(kHeel, h), toes = scaled(kToes, h);
  const double heel_back = .23 * l.foot - heel.lateral, toe_ahead = .77 * l.foot - toes.lateral;
  body.parts.push_back({foot, ankle(side),
                        Eigen::Vector3d(-heel_back, 0, heel.forward - l.ankle_height),
                        Eigen::Vector3d(toe_ahead, 0, toes.forward - l.ankle_height), heel, toes,
                        Appearance::kFeet});
}

void add_arm(Body& body, Side side) {
  const double h = body.subject.height;
  const double w = h * body.subject.girth;
  const BodyLengths& l = body.lengths;
  const bool left = side == Side::kLeft;
  const Joint shoulder = left ? Joint::kLeftShoulder : Joint::kRightShoulder;
  const Joint elbow = left ? Joint::kLeftElbow : Joint::kRightElbow;
  const Segment upper = left ? Segment::kLeftUpperArm : Segment::kRightUpperArm;
  const Segment fore = left ? Segment::kLeftForearm : Segment::kRightForearm;
  const double hand = .075 * h;  // a loosely closed hand extends the forearm
  body.parts.push_back({upper, shoulder, up(-l.upper_arm), up(0), scaled(kElbow, w),
                        scaled(kUpperArmTop, w), Appearance::kTrunk});
  body.parts.push_back({fore, elbow, up(-l.forearm - hand), up(0), scaled(kWrist, w),
                        scaled(kElbow, w), Appearance::kArms});
}

}  // namespace

Body make_body(const Subject& subject, const BodyGroups& groups) {
  Body body{subject, groups, body_lengths(subject), {}};
  add_trunk(body);
  for (const Side side : {Side::kLeft, Side::kRight}) add_leg(body, side);
  if (groups.head) add_head(body);
  if (groups.arms) {
    for (const Side side : {Side::kLeft, Side::kRight}) add_arm(body, side);
  }
  return body;
}

}  // namespace body
}  // namespace walktrack
