#include "jobs/track/checked_job.h"

#include <fmt/format.h>

#include "core/errors.h"
#include "jobs/track/input/detections.h"

namespace walktrack {
inline namespace jobs {

namespace {

// Without any term the result would only show the gait prior.
void require_a_term(const ObservationConfig& observation) {
  const std::vector<TermSwitch> switches = term_switches();
  std::vector<std::string_view> names;
  for (const TermSwitch& each : switches) {
    if (each.on(observation)) return;
    names.push_back(each.key);
  }
  throw UsageError(
      describe({"", 0, "observation"}, "no term that is enabled",
               fmt::format("one or more of {} with enabled: true", fmt::join(names, ", "))));
}

// The findings of the scene's checks as lines.
std::vector<std::string> lines_of(const CheckReport& report, const TrackJob& job,
                                  const JobControl& control) {
  std::vector<std::string> notes;
  std::string failure;
  int more = -1;
  for (const Finding& finding : report.findings) {
    if (finding.failure && failure.empty()) failure = finding_line(finding);
    if (finding.failure) ++more;
    notes.push_back((finding.failure ? "a failed check was ignored: " : "") +
                    finding_line(finding));
  }
  if (!failure.empty() && !job.ignore_checks) {
    throw InputError(fmt::format(
        "{}: {}{} (--ignore-checks tracks it as it is)", job.scene.file.string(), failure,
        more > 0 ? fmt::format("; and {} more, see walktrack check", more) : std::string()));
  }
  for (const std::string& note : notes) control.say(note);
  return notes;
}

}  // namespace

CheckedJob checked_job(const TrackJob& given, const JobControl& control) {
  CheckedJob out{given, {}, {}};
  out.job.config.values = decided(given.scene, given.config.values);
  require_a_term(out.job.config.values.observation);
  const CheckReport report = look_at_scene(given.scene, control);
  out.findings = lines_of(report, given, control);
  out.lag = report.lag;
  if (out.lag) out.job.scene.cameras[out.lag->camera].start_frame = out.lag->frames;
  return out;
}

}  // namespace jobs
}  // namespace walktrack
