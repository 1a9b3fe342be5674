// People who are not built or dressed as the tracker's body is: what a body's parts become on
// somebody else, and what is worn over them. Joints stay where they are. Pictures of such people
// test the tracker against figures that its own shapes cannot take.
#pragma once

#include "body/body.h"

namespace walktrack {
inline namespace synth {

struct Shape {
  double girth = 1;     // factor on every width but the head's and the feet's
  double head = 1;      // factor on the head's widths and height
  double belly = 0;     // m that the waist reaches further forward
  double trousers = 0;  // m that wide trousers stand off the ankles on every side
  double skirt = 0;     // share of the thighs that a skirt hides, widening downwards; 0 = none
  double pack = 0;      // m that a bag on the back is deep; 0 = none
};

// The body's parts in this shape; a skirt and a bag are parts more, at the end.
Body shaped(Body body, const Shape& shape);

}  // namespace synth
}  // namespace walktrack
