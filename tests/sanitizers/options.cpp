// SPDX-License-Identifier: BSD-3-Clause
// Linked into every program of a sanitizer build, so that it behaves the same however it is
// started. A suppression names a library of Mesa or LLVM, never a function of ours.

extern "C" {

// A leak in a library can be told by the library's name only while that is loaded, and a window
// unloads Mesa's when it closes.
int dlclose(void*) {
    return 0;
}

const char* __asan_default_options() {
    return "detect_stack_use_after_return=1:strict_string_checks=1:check_initialization_order=1:"
           "allocator_may_return_null=1";
}

const char* __ubsan_default_options() {
    return "print_stacktrace=1";
}

const char* __lsan_default_options() {
    return "print_suppressions=0";
}

// Mesa keeps per-process tables, and LLVM its compiled code, until the process ends.
const char* __lsan_default_suppressions() {
    return "leak:libOSMesa.so\n"
           "leak:libGLX\n"
           "leak:swrast_dri.so\n"
           "leak:libgallium\n"
           "leak:libLLVM\n";
}

const char* __tsan_default_options() {
    return "second_deadlock_stack=1";
}

// None of these libraries is instrumented, so what happens inside it can't be judged.
const char* __tsan_default_suppressions() {
    return "called_from_lib:libOSMesa.so\n"
           "called_from_lib:libEGL_mesa.so\n"
           "called_from_lib:libGLX_mesa.so\n"
           "called_from_lib:swrast_dri.so\n"
           "called_from_lib:libgallium\n"
           "called_from_lib:libLLVM\n"
           // Mutexes that may be locked twice, but are initialised where the sanitizer can't see
           // it, and that these libraries lock around each other, on the one thread that has
           // windows.
           "mutex:libGLdispatch.so\n"
           "mutex:libGLX.so\n"
           "mutex:libX11.so\n"
           "mutex:libxcb.so\n"
           "mutex:libglfw.so\n"
           "deadlock:libGLX\n"
           "deadlock:libX11.so\n"
           // LLVM registers what it compiles with the unwinder; of the unwinder's lock the
           // sanitizer sees the taking but, inside LLVM, not the release.
           "deadlock:__register_frame_info\n"
           "deadlock:__deregister_frame_info\n";
}
}
