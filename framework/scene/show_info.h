// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;
/// <showInfo>: the frame rate and what InfoTexts say (ork reference 2.17).
void declareShowInfo(Registry& registry);

} // namespace terrane
