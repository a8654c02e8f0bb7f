//! What the instruction sets have in common: lanes in one register or several, and the way in.
//!
//! Long because: two macros, which stand for the code of all instruction sets.

/// Defines a type of eight lanes held in `$count` registers, and its operations, by the names
/// of the intrinsics.
macro_rules! registers {
    (
        $name:ident: $scalar:ty, [$register:ty; $count:literal],
        $load:ident, $store:ident, $splat:ident,
        $add:ident, $sub:ident, $mul:ident, $div:ident, $min:ident, $max:ident,
        $sqrt:ident, $less:ident, $less_or_equal:ident, $select:ident, $if_less:ident
    ) => {
        registers!(@memory $name, $scalar, LANES, [$register; $count], $load, $store, $splat);

        impl $name {
            registers!(@pairwise $name, $count, min_registers, $min);
            registers!(@pairwise $name, $count, max_registers, $max);
        }

        registers!(@operator $name, $count, Add, add, $add);
        registers!(@operator $name, $count, Sub, sub, $sub);
        registers!(@operator $name, $count, Mul, mul, $mul);
        registers!(@operator $name, $count, Div, div, $div);

        impl Neg for $name {
            type Output = $name;

            #[inline(always)]
            fn neg(self) -> $name {
                // SAFETY: lanes exist only where the processor has the instructions. The
                // difference from -0 changes the sign of all numbers, of zeros too.
                unsafe { $name::splat(-0.0) - self }
            }
        }

        impl Float<$scalar> for $name {
            #[inline(always)]
            fn min(self, other: $name) -> $name {
                self.min_registers(other)
            }

            #[inline(always)]
            fn max(self, other: $name) -> $name {
                self.max_registers(other)
            }

            #[inline(always)]
            fn sqrt(self) -> $name {
                let mut result = self.0;
                for result in &mut result {
                    // SAFETY: lanes exist only where the processor has the instructions.
                    *result = unsafe { $sqrt(*result) };
                }
                $name(result)
            }

            registers!(@compare $name, less, $less);
            registers!(@compare $name, less_or_equal, $less_or_equal);

            #[inline(always)]
            fn select(self, mask: u8, other: $name) -> $name {
                let mut result = self.0;
                for (k, (result, other)) in result.iter_mut().zip(other.0).enumerate() {
                    // SAFETY: lanes exist only where the processor has the instructions.
                    *result = unsafe { $select(mask >> (k * Self::WIDTH), *result, other) };
                }
                $name(result)
            }

            #[inline(always)]
            fn if_less(self, other: $name, then: $name, otherwise: $name) -> $name {
                let mut result = self.0;
                for (k, result) in result.iter_mut().enumerate() {
                    let (other, then, otherwise) = (other.0[k], then.0[k], otherwise.0[k]);
                    // SAFETY: lanes exist only where the processor has the instructions.
                    *result = unsafe { $if_less(*result, other, then, otherwise) };
                }
                $name(result)
            }

            #[inline(always)]
            fn lanes(self) -> [$scalar; LANES] {
                self.store()
            }
        }
    };

    // Twice as many lanes, which only multiply and add.
    (
        @wide $name:ident: [$register:ty; $count:literal],
        $load:ident, $store:ident, $splat:ident, $add:ident, $mul:ident
    ) => {
        registers!(@memory $name, f32, WIDE, [$register; $count], $load, $store, $splat);
        registers!(@operator $name, $count, Add, add, $add);
        registers!(@operator $name, $count, Mul, mul, $mul);

        impl WideFloat for $name {
            #[inline(always)]
            fn lanes(self) -> [f32; WIDE] {
                self.store()
            }

            #[inline(always)]
            fn totals(four: [$name; 4]) -> [f32; 4] {
                // SAFETY: lanes exist only where the processor has the instructions.
                unsafe { totals(four) }
            }
        }
    };

    (
        @memory $name:ident, $scalar:ty, $lanes:ident, [$register:ty; $count:literal],
        $load:ident, $store:ident, $splat:ident
    ) => {
        #[derive(Clone, Copy)]
        pub(crate) struct $name([$register; $count]);

        impl $name {
            const WIDTH: usize = $lanes / $count;

            /// Loads lanes. Only where the processor has the instructions.
            #[inline(always)]
            pub(crate) unsafe fn load(lanes: &[$scalar; $lanes]) -> $name {
                // SAFETY: the caller's for the instruction; every register reads its own part
                // of the array.
                unsafe {
                    let mut registers = [$splat(0.0); $count];
                    for (k, register) in registers.iter_mut().enumerate() {
                        *register = $load(lanes.as_ptr().add(k * Self::WIDTH));
                    }
                    $name(registers)
                }
            }

            /// The same number everywhere. Only where the processor has the instructions.
            #[inline(always)]
            pub(crate) unsafe fn splat(number: $scalar) -> $name {
                // SAFETY: the caller's.
                $name([unsafe { $splat(number) }; $count])
            }

            #[inline(always)]
            fn store(self) -> [$scalar; $lanes] {
                let mut lanes = [0.0; $lanes];
                for (k, register) in self.0.into_iter().enumerate() {
                    // SAFETY: lanes exist only where the processor has the instructions; every
                    // register writes its own part of the array.
                    unsafe { $store(lanes.as_mut_ptr().add(k * Self::WIDTH), register) };
                }
                lanes
            }
        }
    };

    (@operator $name:ident, $count:literal, $trait:ident, $method:ident, $intrinsic:ident) => {
        impl $trait for $name {
            type Output = $name;

            registers!(@pairwise $name, $count, $method, $intrinsic);
        }
    };

    (@pairwise $name:ident, $count:literal, $method:ident, $intrinsic:ident) => {
        #[inline(always)]
        fn $method(self, other: $name) -> $name {
            let mut result = self.0;
            for (result, other) in result.iter_mut().zip(other.0) {
                // SAFETY: lanes exist only where the processor has the instructions.
                *result = unsafe { $intrinsic(*result, other) };
            }
            $name(result)
        }
    };

    (@compare $name:ident, $method:ident, $compare:ident) => {
        #[inline(always)]
        fn $method(self, other: $name) -> u8 {
            let mut mask = 0;
            for (k, (a, b)) in self.0.into_iter().zip(other.0).enumerate() {
                // SAFETY: lanes exist only where the processor has the instructions.
                mask |= unsafe { $compare(a, b) } << (k * Self::WIDTH);
            }
            mask
        }
    };
}

/// Defines the type of an instruction set, `run`, which alone makes it, and its loads.
macro_rules! entrance {
    ($name:ident, $features:literal) => {
        /// Made by [`run`] alone.
        #[derive(Clone, Copy)]
        pub(crate) struct $name(());

        #[inline]
        pub(crate) fn run<K: Kernel>(set: InstructionSet, kernel: K) -> K::Output {
            assert_eq!(set.0, Name::$name);
            // SAFETY: `InstructionSet::available` makes this value only where the processor has
            // what the function asks for. The type and lanes exist only inside it, so all
            // intrinsics of the module run there.
            unsafe { enter(kernel) }
        }

        #[target_feature(enable = $features)]
        fn enter<K: Kernel>(kernel: K) -> K::Output {
            kernel.run($name(()))
        }

        impl Simd for $name {
            type F32 = F32;
            type F64 = F64;
            type Wide = Wide;

            #[inline(always)]
            fn f32(self, lanes: &[f32; LANES]) -> F32 {
                // SAFETY: see `run`.
                unsafe { F32::load(lanes) }
            }

            #[inline(always)]
            fn f64(self, lanes: &[f64; LANES]) -> F64 {
                // SAFETY: see `run`.
                unsafe { F64::load(lanes) }
            }

            #[inline(always)]
            fn splat_f32(self, number: f32) -> F32 {
                // SAFETY: see `run`.
                unsafe { F32::splat(number) }
            }

            #[inline(always)]
            fn splat_f64(self, number: f64) -> F64 {
                // SAFETY: see `run`.
                unsafe { F64::splat(number) }
            }

            #[inline(always)]
            fn wide(self, lanes: &[f32; WIDE]) -> Wide {
                // SAFETY: see `run`.
                unsafe { Wide::load(lanes) }
            }

            #[inline(always)]
            fn splat_wide(self, number: f32) -> Wide {
                // SAFETY: see `run`.
                unsafe { Wide::splat(number) }
            }

            #[inline(always)]
            fn narrow(self, numbers: F64) -> F32 {
                // SAFETY: see `run`.
                unsafe { narrow(numbers) }
            }

            #[inline(always)]
            fn widen(self, numbers: F32) -> F64 {
                // SAFETY: see `run`.
                unsafe { widen(numbers) }
            }

            #[inline(always)]
            fn prefetch<T>(self, items: &[T]) {
                // SAFETY: see `run`. No address is wrong for a hint.
                unsafe { _mm_prefetch::<_MM_HINT_T1>(items.as_ptr().cast()) }
            }
        }
    };
}

pub(crate) use {entrance, registers};
