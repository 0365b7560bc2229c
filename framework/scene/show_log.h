// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

class Registry;
/// <showLog>: the newest lines of the MessageLog (ork reference 2.17).
void declareShowLog(Registry& registry);

} // namespace terrane
