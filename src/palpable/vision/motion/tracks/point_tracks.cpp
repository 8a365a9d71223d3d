// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/tracks/point_tracks.hpp"

#include "palpable/vision/image/opencv_image.hpp"
#include "palpable/vision/motion/tracks/affine_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace palpable::vision {
namespace {

using Pyramid = std::vector<cv::Mat>;

// A tracked point: its track, and the frame from which its template is taken.
struct Followed {
  std::size_t track = 0;
  int template_frame = 0;
  cv::Point2f in_template;
  cv::Point2f last;
};

class Tracker {
 public:
  explicit Tracker(const TrackOptions& options) : options_(options) {}

  void add(int frame, const cv::Mat& grey) {
    Pyramid pyramid;
    cv::buildOpticalFlowPyramid(grey, pyramid, window(), options_.levels);
    pyramids_.push_back({frame, std::move(pyramid)});
    if (frame > 0) follow(frame);
    while (pyramids_.front().frame < frame - options_.frames_per_template) pyramids_.pop_front();
    renew_templates(frame);
    if (most_wanted() > static_cast<int>(followed_.size())) find_new(frame, grey);
  }
  std::vector<PointTrack> take() {
    std::erase_if(tracks_, [](const PointTrack& track) { return track.places.size() < 2; });
    return std::move(tracks_);
  }

 private:
  struct PyramidOf {
    int frame = 0;
    Pyramid levels;
  };
  cv::Size window() const { return {options_.window_px, options_.window_px}; }
  int most_wanted() const { return options_.most_points; }
  const Pyramid& pyramid_of(int frame) const {
    return std::find_if(pyramids_.begin(), pyramids_.end(),
                        [&](const PyramidOf& p) { return p.frame == frame; })
        ->levels;
  }

  // Tracks all points into `frame`, those with the same template frame together.
  void follow(int frame) {
    std::vector<Followed> kept;
    for (int first = frame - options_.frames_per_template; first < frame; ++first) {
      std::vector<Followed> group;
      std::copy_if(followed_.begin(), followed_.end(), std::back_inserter(group),
                   [&](const Followed& point) { return point.template_frame == first; });
      if (!group.empty()) follow_group(group, first, frame, kept);
    }
    followed_ = std::move(kept);
  }

  void follow_group(std::vector<Followed>& group, int first, int frame, std::vector<Followed>& kept) {
    std::vector<cv::Point2f> from, to, back;
    for (const Followed& point : group) from.push_back(point.in_template), to.push_back(point.last);
    std::vector<std::uint8_t> found, returned;
    const cv::TermCriteria stop(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 30, 0.005);
    const int flags = cv::OPTFLOW_USE_INITIAL_FLOW;
    const cv::Mat size = pyramid_of(frame)[0];
    cv::calcOpticalFlowPyrLK(pyramid_of(first), pyramid_of(frame), from, to, found, cv::noArray(), window(),
                             options_.levels, stop, flags, 1e-4);
    back = from;
    cv::calcOpticalFlowPyrLK(pyramid_of(frame), pyramid_of(first), to, back, returned, cv::noArray(),
                             window(), options_.levels, stop, flags, 1e-4);
    for (std::size_t i = 0; i < group.size(); ++i) {
      const cv::Point2f error = back[i] - from[i];
      const bool inside = to[i].x >= 0 && to[i].y >= 0 && to[i].x <= static_cast<float>(size.cols - 1) &&
                          to[i].y <= static_cast<float>(size.rows - 1);
      if (!found[i] || !returned[i] || !inside || std::hypot(error.x, error.y) > options_.return_limit_px)
        continue;
      group[i].last = to[i];
      tracks_[group[i].track].places.push_back({to[i].x, to[i].y});
      kept.push_back(group[i]);
    }
  }

  void renew_templates(int frame) {
    for (Followed& point : followed_)
      if (frame - point.template_frame >= options_.frames_per_template)
        point.template_frame = frame, point.in_template = point.last;
  }

  void find_new(int frame, const cv::Mat& grey) {
    cv::Mat free(grey.size(), CV_8U, cv::Scalar(255));
    const int distance = static_cast<int>(std::lround(options_.least_distance_px));
    for (const Followed& point : followed_) cv::circle(free, point.last, distance, cv::Scalar(0), cv::FILLED);
    std::vector<cv::Point2f> corners;
    cv::goodFeaturesToTrack(grey, corners, most_wanted() - static_cast<int>(followed_.size()),
                            options_.least_quality, options_.least_distance_px, free, 5);
    for (const cv::Point2f& corner : corners) {
      followed_.push_back({tracks_.size(), frame, corner, corner});
      tracks_.push_back({frame, {{corner.x, corner.y}}});
    }
  }

  TrackOptions options_;
  std::deque<PyramidOf> pyramids_;
  std::vector<Followed> followed_;
  std::vector<PointTrack> tracks_;
};

}  // namespace

std::vector<Parameter> parameters_of(TrackOptions& o) {
  return {
      {"most_points", &o.most_points, {16, 20000}, "", "Points followed at the same time"},
      {"least_distance_px", &o.least_distance_px, {2, 100}, "px", "Distance of new points from others"},
      {"least_quality", &o.least_quality, {1e-4, 1}, "", "Weakest corner, as a share of the strongest"},
      {"window_px", &o.window_px, {5, 61}, "px", "Side of the window that is compared; odd"},
      {"levels", &o.levels, {0, 8}, "", "Halvings of the picture"},
      {"return_limit_px",
       &o.return_limit_px,
       {0.01, 10},
       "px",
       "Error at which a point followed back is lost"},
      {"frames_per_template", &o.frames_per_template, {1, 100}, "", "Frames with one template of a point"}};
}

Result<std::vector<PointTrack>> track_points(std::span<const Raster<std::uint8_t>> frames,
                                             const TrackOptions& options, const Work& work) {
  if (auto checked = check_ranges(options); !checked) return checked.error();
  Tracker tracker(options);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (work.cancelled()) return Work::interrupted();
    if (frames[i].width() != frames[0].width() || frames[i].height() != frames[0].height())
      return invalid_input("the frames of a video must have one size");
    tracker.add(static_cast<int>(i), grey_view_of(frames[i]));
    work.report(static_cast<double>(i + 1) / static_cast<double>(frames.size()), "following points");
  }
  std::vector<PointTrack> tracks = affine_tracks(frames, tracker.take(), PatchOptions{}, work);
  if (work.cancelled()) return Work::interrupted();
  return tracks;
}

}  // namespace palpable::vision
