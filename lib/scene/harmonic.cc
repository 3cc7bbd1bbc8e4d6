#include "lib/scene/harmonic.h"

#include <algorithm>
#include <utility>

namespace orthodyn {

template <>
struct EnumNames<Spacing> {
  static constexpr std::array<std::pair<Spacing, const char*>, 2> list{
      {{Spacing::logarithmic, "logarithmic"}, {Spacing::linear, "linear"}}};
};

namespace {

void check_loss(const MaterialLoss& loss, const Config& config) {
  if (loss.factor.has_value() + loss.quality.has_value() + loss.young.has_value() != 1)
    config.fail("give exactly one of: factor, quality, young (with shear)");
  if (loss.young.has_value() != loss.shear.has_value()) config.fail("'young' and 'shear' belong together");
  for (const auto& [key, values] : {std::pair{"young", loss.young}, {"shear", loss.shear}})
    if (values && values->size() != 3) config.at(key).fail("expected a list of 3 loss factors");
}

void check_list(const std::vector<double>& frequencies, const Config& config) {
  if (frequencies.empty()) config.fail("is empty; give at least one frequency");
  if (!std::is_sorted(frequencies.begin(), frequencies.end(), std::less_equal<>()))
    config.fail("must ascend, without repetition");
}

void check_harmonic(const Harmonic& harmonic, const Config& config) {
  if (harmonic.frequencies) {
    if (harmonic.from || harmonic.to) config.fail("give either 'frequencies', or 'from' and 'to'");
    if (harmonic.points || harmonic.spacing || harmonic.resonances)
      config.fail("'points', 'spacing' and 'resonances' belong to 'from' and 'to'; remove them, or 'frequencies'");
    check_list(*harmonic.frequencies, config.at("frequencies"));
    return;
  }
  if (!harmonic.from || !harmonic.to) config.fail("give the range of frequencies by 'from' and 'to'");
  if (!(*harmonic.to > *harmonic.from)) config.fail("'to' must be above 'from'");
  if (!harmonic.points) config.fill("points", "200");
  if (!harmonic.spacing) config.fill("spacing", "logarithmic");
  if (!harmonic.resonances) config.fill("resonances", "true");
}

}  // namespace

const Spec<MaterialLoss>& MaterialLoss::spec() {
  static const auto s =
      Spec<MaterialLoss>()
          .key("factor", &MaterialLoss::factor, "Loss factor of all strains, the reciprocal of the quality factor Q.",
               {.range = {0, 1}})
          .key("quality", &MaterialLoss::quality, "Quality factor Q of all strains.", {.range = {.low = 1}})
          .key("young", &MaterialLoss::young, "Loss factors of Young's moduli along the material axes 1, 2, 3.",
               {.range = {0, 1}})
          .key("shear", &MaterialLoss::shear, "Loss factors of the shear moduli G12, G23, G31.", {.range = {0, 1}})
          .check(check_loss);
  return s;
}

const Spec<Harmonic>& Harmonic::spec() {
  static const auto s =
      Spec<Harmonic>()
          .key("from", &Harmonic::from, "Lowest frequency.", {.unit = "Hz", .range = kPositive})
          .key("to", &Harmonic::to, "Highest frequency.", {.unit = "Hz", .range = kPositive})
          .key("points", &Harmonic::points, "Number of frequencies from `from` to `to`; default 200.",
               {.range = {2, 100000}})
          .key("spacing", &Harmonic::spacing, "Spacing of these frequencies; default logarithmic.")
          .key("resonances", &Harmonic::resonances,
               "Also compute the response at each natural frequency in the range and beside it, as closely as the "
               "damping makes the resonance sharp; default true.")
          .key("frequencies", &Harmonic::frequencies, "Frequencies, instead of `from` and `to`.",
               {.unit = "Hz", .range = kPositive})
          .key("damping_ratio", &Harmonic::damping_ratio,
               "Damping of each mode relative to critical damping, added to all other damping.", {.range = {0, 1}})
          .key("losses", &Harmonic::losses, "Loss factors by material. A material without an entry has none.")
          .key("base_acceleration", &Harmonic::base_acceleration,
               "Amplitude of the acceleration of all supports, which vibrate together.", {.unit = "m/s^2"})
          .key("tap_seconds", &Harmonic::tap_seconds,
               "Also write the sound of a tap, by which the loads act for an instant instead of vibrating, of this "
               "length: taps/PROBE.wav for each probe of a motion.",
               {.unit = "s", .range = {0, 60, true, false}})
          .key("rtol", &Harmonic::rtol, "Tolerance of the computed amplitudes for this mesh, in the energy norm.",
               {.range = {1e-10, 0.1}})
          .check(check_harmonic);
  return s;
}

}  // namespace orthodyn
