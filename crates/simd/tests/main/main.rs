//! Kernels on all instruction sets of the machine.

mod same_bits;
