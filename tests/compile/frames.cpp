// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0

// Each macro adds one error that the compiler must reject; without any, the file must compile.
#include "palpable/core/frame.hpp"

using palpable::Point;
using palpable::Transform;
using palpable::Vector;
using Scene = palpable::SceneFrame;
using Device = palpable::DeviceFrame;

void frames(Point<Scene> point, Vector<Scene> vector, Point<Device> device_point,
            Vector<Device> device_vector, Transform<Scene, Device> scene_from_device,
            Transform<Device, Scene> device_from_scene) {
#if defined(ADDS_TWO_POINTS)
  auto wrong = point + point;
#elif defined(SCALES_A_POINT)
  auto wrong = 2.0 * point;
#elif defined(SUBTRACTS_A_POINT_FROM_A_VECTOR)
  auto wrong = vector - point;
#elif defined(TAKES_A_POINT_FOR_A_VECTOR)
  Vector<Scene> wrong = point;
#elif defined(SUBTRACTS_POINTS_OF_TWO_FRAMES)
  auto wrong = point - device_point;
#elif defined(ADDS_VECTORS_OF_TWO_FRAMES)
  auto wrong = vector + device_vector;
#elif defined(DOTS_VECTORS_OF_TWO_FRAMES)
  auto wrong = dot(vector, device_vector);
#elif defined(ASSIGNS_ACROSS_FRAMES)
  point = device_point;
#elif defined(TRANSFORMS_FROM_THE_WRONG_FRAME)
  auto wrong = scene_from_device * point;
#elif defined(TRANSFORMS_INTO_THE_WRONG_FRAME)
  Point<Device> wrong = scene_from_device * device_point;
#elif defined(COMPOSES_FRAMES_THAT_DO_NOT_MEET)
  auto wrong = scene_from_device * scene_from_device;
#elif defined(TAKES_AN_INVERSE_FOR_ITSELF)
  Transform<Scene, Device> wrong = scene_from_device.inverse();
#elif defined(TURNS_A_FORCE_OF_THE_WRONG_FRAME)
  auto wrong = rotate_force(scene_from_device, vector);
#endif
  point = scene_from_device * device_point + 2.0 * (vector + scene_from_device * device_vector);
  device_point = scene_from_device.inverse() * point;
  device_from_scene = scene_from_device.inverse();
  static_cast<void>(scene_from_device * device_from_scene);
  static_cast<void>(dot(vector, rotate_force(scene_from_device, device_vector)));
}
