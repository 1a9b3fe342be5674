// People with other shapes or clothes than the tracker's body model: changes of a body's parts, and
// additional parts for clothes. Joints do not change. Images of such people test the tracker with
// outlines that its own model cannot have.
#pragma once

#include "body/body.h"

namespace walktrack {
inline namespace synth {

struct Shape {
  double girth = 1;     // factor on every width except the head's and the feet's
  double head = 1;      // factor on the head's widths and height
  double belly = 0;     // m by which the waist is extended forward
  double trousers = 0;  // m by which wide trousers extend beyond the ankles to every side
  double skirt = 0;     // share of the thighs that a skirt covers, wider at the bottom; 0 = none
  double pack = 0;      // m, depth of a bag on the back; 0 = none
};

// The body's parts with this shape; a skirt and a bag are additional parts at the end.
Body shaped(Body body, const Shape& shape);

}  // namespace synth
}  // namespace walktrack
