#pragma once

namespace articular::tools {

/// Sees to arithmetic that has the same bits on every x86-64 processor. OpenBLAS and the C library
/// choose their kernels by the processor while they are loaded, and ask the environment then: where
/// it does not say what they need, the program starts itself anew, with the same arguments, before
/// it has read or written anything. Back from that, our own kernels follow.
/// @throws SystemError where a library does not do as it is told
void use_portable_arithmetic();

}  // namespace articular::tools
