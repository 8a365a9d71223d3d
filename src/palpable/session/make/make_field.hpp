// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/make/make_scene.hpp"

#include <filesystem>

namespace palpable::session {

/// A distance field of a file of a mesh, of points with normals, of superquadrics, or an OpenVDB level set.
/// With options.relief.size_m the solid is scaled into that box, its lowest point at z = 0 and its middle
/// over the origin; else it keeps its metres and origin. Errors: as make_scene().
Result<MadeScene> field_from_file(const MakeOptions& options, const sources::Input& input, const Work& work);

/// The volume behind a relief's visible surface (Park & Howard 2012), down to a base plate, as a field.
/// `relief` is the made scene's. Errors: as sculpt::field_from_source().
Result<MadeScene> field_from_relief(const MadeScene& made, const models::Relief& relief,
                                    const MakeOptions& options, const Work& work);

}  // namespace palpable::session
