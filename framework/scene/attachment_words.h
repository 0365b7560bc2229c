// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/framebuffer.h"
#include "resource/value_traits.h"

namespace terrane {

inline const Words<AttachmentPoint> kAttachmentWords{
    {"NONE", AttachmentPoint::none},       {"COLOR0", AttachmentPoint::colour0},
    {"COLOR1", AttachmentPoint::colour1},  {"COLOR2", AttachmentPoint::colour2},
    {"COLOR3", AttachmentPoint::colour3},  {"COLOR4", AttachmentPoint::colour4},
    {"COLOR5", AttachmentPoint::colour5},  {"COLOR6", AttachmentPoint::colour6},
    {"COLOR7", AttachmentPoint::colour7},  {"DEPTH", AttachmentPoint::depth},
    {"STENCIL", AttachmentPoint::stencil},
};

} // namespace terrane
