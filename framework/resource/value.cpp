// SPDX-License-Identifier: BSD-3-Clause
#include "resource/value.h"

#include "resource/entry.h"

namespace terrane {

Resource* RefBase::instance() const {
    return entry_ ? entry_->instance.get() : nullptr;
}

std::shared_ptr<Resource> RefBase::sharedInstance() const {
    return entry_ ? entry_->instance : nullptr;
}

} // namespace terrane
