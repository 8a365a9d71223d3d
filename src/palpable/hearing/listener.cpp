// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/hearing/listener.hpp"

#include "palpable/core/check.hpp"
#include "palpable/hearing/half_window.hpp"
#include "palpable/hearing/spectrum.hpp"
#include "palpable/hearing/steered_response.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

namespace palpable::hearing {
namespace {

double decibel(double power) { return 10.0 * std::log10(std::max(power, 1e-20)); }

}  // namespace

struct Listener::Impl {
  Impl(const Microphones& array, const ArrayGeometry& shape, double rate, const ListenerOptions& wanted)
      : options(wanted),
        geometry(shape),
        rate_hz(rate),
        size(std::bit_ceil(static_cast<std::size_t>(0.75 * wanted.frame_s * rate))),
        // Lags so fine that a cubic joins them.
        finer(std::bit_ceil(static_cast<std::size_t>(std::ceil(192'000.0 / rate)))),
        response(array, shape, rate * static_cast<double>(finer)),
        waiting(array.positions_m.size()),
        speed_m_per_s(array.speed_of_sound_m_per_s),
        positions(array.positions_m) {
    const double bin_hz = rate_hz / static_cast<double>(size);
    first_bin = static_cast<std::size_t>(std::ceil(options.low_hz / bin_hz));
    last_bin = static_cast<std::size_t>(std::min(options.high_hz, 0.45 * rate_hz) / bin_hz);
    const double frames_per_s = 2.0 * rate_hz / static_cast<double>(size);
    frames_in_half = std::max(1, static_cast<int>(std::lround(0.5 * options.window_s * frames_per_s)));
    weights = std::make_unique<SoundWeights>(bins(), frames_per_s, options.weights);
    for (std::size_t i = 0; i < size; ++i)
      taper.push_back(static_cast<float>(
          0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(size))));
    halves = {empty_half(), empty_half()};
  }

  std::size_t bins() const { return last_bin - first_bin + 1; }
  HalfWindow empty_half() const { return {response.pairs().size(), bins()}; }

  void take_frame() {
    std::vector<Spectrum> spectra;
    std::vector<float> tapered(size), power(bins());
    for (const auto& channel : waiting) {
      for (std::size_t i = 0; i < size; ++i) tapered[i] = taper[i] * channel[i];
      Spectrum whole = spectrum_of(tapered);
      spectra.emplace_back(whole.begin() + static_cast<std::ptrdiff_t>(first_bin),
                           whole.begin() + static_cast<std::ptrdiff_t>(last_bin + 1));
      for (std::size_t bin = 0; bin < power.size(); ++bin)
        power[bin] += std::norm(spectra.back()[bin]) / static_cast<float>(waiting.size());
    }
    halves[1].take(response.pairs(), spectra, power, weights->take(power));
    for (auto& channel : waiting)
      channel.erase(channel.begin(), channel.begin() + static_cast<std::ptrdiff_t>(size / 2));
    taken += size / 2;
  }

  /// The correlation of a pair from the sum of its spectra, 1 where all bins agree.
  void fill(PairCorrelation& pair, const Spectrum& a, const Spectrum& b, double weight) const {
    Spectrum padded(finer * size / 2 + 1);
    // Half the size times the inverse transform's factor: a bin counts twice, with its negative frequency.
    const auto scale = static_cast<float>(0.5 * static_cast<double>(finer * size) / weight);
    for (std::size_t bin = 0; bin < a.size(); ++bin) padded[first_bin + bin] = scale * (a[bin] + b[bin]);
    const std::vector<float> circle = samples_of(padded);
    const int most = response.most_lag(), length = static_cast<int>(circle.size());
    pair.at_lag.assign(static_cast<std::size_t>(2 * most + 1), 0.0F);
    for (int lag = std::max(-most, 1 - length / 2); lag <= std::min(most, length / 2 - 1); ++lag)
      pair.at_lag[static_cast<std::size_t>(lag + most)] =
          circle[static_cast<std::size_t>(lag < 0 ? lag + length : lag)];
  }

  /// The mean over the pairs of the power that they share after the delays of a direction.
  double shared_power(Vec3 direction) const {
    double sum = 0.0;
    const double bin_rad_per_s = 2.0 * std::numbers::pi * rate_hz / static_cast<double>(size);
    for (std::size_t p = 0; p < response.pairs().size(); ++p) {
      const auto& pair = response.pairs()[p];
      const double later_s =
          dot(direction, positions[pair.second].v - positions[pair.first].v) / speed_m_per_s;
      for (std::size_t bin = 0; bin < bins(); ++bin) {
        const double phase = bin_rad_per_s * static_cast<double>(first_bin + bin) * later_s;
        const std::complex<float> product = halves[0].plain[p][bin] + halves[1].plain[p][bin];
        sum += double{product.real()} * std::cos(phase) - double{product.imag()} * std::sin(phase);
      }
    }
    return std::max(0.0, sum / static_cast<double>(response.pairs().size()));
  }

  HeardWindow judge() const {
    const double end_s = static_cast<double>(taken + size / 2) / rate_hz;
    const int frames = halves[0].frames + halves[1].frames;
    HeardWindow out;
    // The last frame of a recording is filled up with silence.
    out.end_s = std::min(end_s, static_cast<double>(given) / rate_hz);
    out.begin_s =
        std::max(0.0, end_s - static_cast<double>((frames + 1) * static_cast<int>(size / 2)) / rate_hz);
    const double power = halves[0].power + halves[1].power, weight = halves[0].weight + halves[1].weight;
    // Parseval: twice for the negative frequencies; 3 / 8 is the taper's mean square.
    const double scale = 2.0 / (static_cast<double>(size) * static_cast<double>(size) * 0.375);
    out.level_db = decibel(scale * power / frames);
    if (out.level_db < options.least_level_db || weight <= 0.0) return out;
    std::vector<PairCorrelation> correlations = response.pairs();
    for (std::size_t pair = 0; pair < correlations.size(); ++pair)
      fill(correlations[pair], halves[0].whitened[pair], halves[1].whitened[pair], weight);
    const ResponsePeak peak = response.find(correlations);
    out.confidence = std::clamp(peak.response - std::max(0.0, peak.mean_response), 0.0, 1.0);
    // A level array hears noise from everywhere as a sound from above.
    constexpr double kSteepest = 0.94;
    const bool is_above =
        geometry.shape == ArrayShape::level && dot(peak.direction.v, geometry.normal) > kSteepest;
    if (out.confidence < options.least_confidence || is_above) return out;
    out.direction = peak.direction;
    out.shared_power = scale * std::min(power, shared_power(peak.direction.v));
    out.other_power = scale * power - out.shared_power;
    return out;
  }

  ListenerOptions options;
  ArrayGeometry geometry;
  double rate_hz;
  /// Samples of a frame, a power of two; the factor between the rates of lags and samples.
  std::size_t size, finer;
  std::size_t first_bin = 0, last_bin = 0;
  int frames_in_half = 1;
  SteeredResponse response;
  std::unique_ptr<SoundWeights> weights;
  std::vector<float> taper;
  /// Samples that no whole frame has come of yet.
  std::vector<std::vector<float>> waiting;
  std::vector<HalfWindow> halves;
  std::size_t taken = 0;
  /// Samples of the recording so far.
  std::size_t given = 0;
  double speed_m_per_s;
  std::vector<Point<CameraFrame>> positions;
};

Listener::Listener(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Listener::Listener(Listener&&) noexcept = default;
Listener& Listener::operator=(Listener&&) noexcept = default;
Listener::~Listener() = default;

Result<Listener> Listener::create(const Microphones& microphones, double rate_hz,
                                  const ListenerOptions& options) {
  if (!(rate_hz >= 8'000.0 && rate_hz <= 192'000.0))
    return invalid_input("has a sample rate outside of 8 to 192 kHz");
  const auto geometry = geometry_of(microphones);
  if (!geometry) return geometry.error();
  return Listener(std::make_unique<Impl>(microphones, *geometry, rate_hz, options));
}

const ArrayGeometry& Listener::geometry() const { return impl_->geometry; }

std::vector<HeardWindow> Listener::take(const Sound& next) {
  PALPABLE_CHECK(next.channels.size() == impl_->waiting.size());
  std::vector<HeardWindow> heard;
  impl_->given += next.length();
  const std::size_t step = impl_->size / 2;
  for (std::size_t begin = 0; begin < next.length(); begin += step) {
    const std::size_t end = std::min(next.length(), begin + step);
    for (std::size_t channel = 0; channel < next.channels.size(); ++channel)
      for (std::size_t i = begin; i < end; ++i) {
        const float sample = next.channels[channel][i];
        impl_->waiting[channel].push_back(std::isfinite(sample) ? sample : 0.0F);
      }
    while (impl_->waiting.front().size() >= impl_->size) {
      impl_->take_frame();
      if (impl_->halves[1].frames < impl_->frames_in_half) continue;
      heard.push_back(impl_->judge());
      impl_->halves[0] = std::exchange(impl_->halves[1], impl_->empty_half());
    }
  }
  return heard;
}

std::optional<HeardWindow> Listener::finish() {
  // Each frame leaves its later half for the next one.
  const bool is_heard = impl_->taken > 0 && impl_->waiting.front().size() <= impl_->size / 2;
  if (!is_heard && !impl_->waiting.front().empty()) {
    for (auto& channel : impl_->waiting) channel.resize(impl_->size);
    impl_->take_frame();
  }
  if (impl_->halves[1].frames == 0) return std::nullopt;
  return impl_->judge();
}

}  // namespace palpable::hearing
