"""The strip solver from a program of its own: no allocation, the same bits every time."""

import re

from installed import HostTest

# Stands in for the C library's functions, in the program and in all libraries it loads.
COUNTER = r"""
#include <stddef.h>
extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);
extern void *__libc_memalign(size_t, size_t);
static long calls;
static void count(void) { __atomic_add_fetch(&calls, 1, __ATOMIC_RELAXED); }
void *malloc(size_t n) { count(); return __libc_malloc(n); }
void *calloc(size_t n, size_t m) { count(); return __libc_calloc(n, m); }
void *realloc(void *p, size_t n) { count(); return __libc_realloc(p, n); }
void *aligned_alloc(size_t a, size_t n) { count(); return __libc_memalign(a, n); }
void *memalign(size_t a, size_t n) { count(); return __libc_memalign(a, n); }
int posix_memalign(void **p, size_t a, size_t n)
{ count(); *p = __libc_memalign(a, n); return *p ? 0 : 12; }
long allocations(void) { return __atomic_load_n(&calls, __ATOMIC_RELAXED); }
"""

MODULE = """
module contacts
    use, intrinsic :: iso_c_binding, only: c_long
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip
    use faststrip_base_material, only: normal_compliance
    use faststrip_contact_wanted, only: target_names
    use faststrip_normal_strip, only: strip_options_t, strip_solve, strip_solve_penetration
    use faststrip_normal_strip_state, only: strip_workspace_t, reserve_strip_workspace, &
                                            set_strip_gap
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    use faststrip_normal_types, only: normal_result_t
    implicit none

    integer, parameter :: points = 601, capacity = 1200, kinds = 5
    real(wp), parameter :: load = 1.0e5_wp

    interface
        integer(c_long) function allocations() bind(c)
            import :: c_long
        end function allocations
    end interface

    !> Room for one thread.
    type :: workspaces_t
        type(strip_workspace_t) :: workspace
        type(contact_strips_t) :: strips
        type(workspace_t) :: contact, wanted
    end type workspaces_t

contains

    !> A gap of one kind: 1 an ellipse, 2 lopsided with a kink, 3 two patches, 4 flat with edges,
    !> 5 rough.
    subroutine make(kind, gap)
        integer, intent(in) :: kind
        type(gap_t), intent(out) :: gap
        integer :: i

        allocate (gap%y(points), gap%h(points), gap%inv2r(points))
        do i = 1, points
            associate (y => gap%y(i), h => gap%h(i))
                y = -15.0_wp + 30.0_wp*(i - 1)/(points - 1)
                select case (kind)
                case (1); h = 2.0e-3_wp*y**2
                case (2); h = merge(4.0e-3_wp, 1.0e-3_wp, y < 1.0_wp)*(y - 1.0_wp)**2
                case (3); h = 6.0e-5_wp*(y*y - 49.0_wp)**2 + 1.0e-3_wp*y
                case (4); h = 0.02_wp*max(abs(y) - 4.0_wp, 0.0_wp)**2
                case (5); h = 2.0e-3_wp*y**2 + 2.0e-4_wp*modulo(i*i, 7)
                end select
            end associate
        end do
        gap%inv2r = 1.0e-3_wp
    end subroutine make

    subroutine reserve(here)
        type(workspaces_t), intent(inout) :: here
        type(status_t) :: status

        call reserve_strips(here%strips, capacity, status)
        call reserve_strip_workspace(here%workspace, capacity, points, status)
        call reserve_workspace(here%contact, contact_methods_t(strips_per_patch=101), points, &
                               status)
        call reserve_workspace(here%wanted, contact_methods_t(normal=normal_auto), points, status)
    end subroutine reserve

    !> Solve a gap from a cold start, for a penetration, and warm, then as a contact with its
    !> estimated errors, and as well as is wanted; add up the bits of all figures.
    subroutine solve(here, gap, n, bits, code)
        type(workspaces_t), intent(inout) :: here
        type(gap_t), intent(in) :: gap
        integer, intent(in) :: n
        integer(int64), intent(out) :: bits
        integer, intent(out) :: code
        type(strip_options_t) :: options
        type(normal_result_t) :: result
        type(contact_case_t) :: case
        type(contact_result_t) :: figures
        type(status_t) :: status
        real(wp) :: compliance
        integer :: step, k

        compliance = normal_compliance(material_t())
        options%strips_per_patch = n
        bits = 0
        code = 0
        do step = 1, 4
            call set_strip_gap(here%workspace, gap, status)
            code = max(code, status%code)
            options%warm_start = step > 1
            if (step == 3) then
                call strip_solve_penetration(here%workspace, compliance, &
                                             1.02_wp*result%penetration, options, here%strips, &
                                             result, status)
            else
                call strip_solve(here%workspace, compliance, load*(1.0_wp + 0.05_wp*(step - 1)), &
                                 options, here%strips, result, status)
            end if
            code = max(code, status%code)
            if (is_error(status)) return
            call add(result%load)
            call add(result%penetration)
            call add(result%area)
            call add(result%pmax)
            do k = 1, here%strips%n
                call add(here%strips%p0(k))
                call add(here%strips%half_length(k))
                call add(here%strips%y_right(k))
            end do
        end do
        call set_contact_gap(here%contact, gap%y, gap%h, gap%inv2r, status)
        case%load = load
        case%methods%strips_per_patch = n
        call solve_contact(here%contact, case, figures, status)
        code = max(code, status%code)
        call add(figures%normal_errors%est_err_pmax)
        call add(figures%normal_errors%est_err_area)
        call add(figures%normal_errors%overlap_outside)
        case%given%is_given = .true.
        case%given%force = [1.0e4_wp, -5.0e3_wp]
        call solve_contact_forces(here%contact, case, figures, status)
        code = max(code, status%code)
        call add(figures%creepage%cksi)
        case%given%is_given = .false.
        case%creepage = creepage_t(1.0e-3_wp, -5.0e-4_wp, 1.0e-4_wp)
        case%methods%normal = normal_auto
        call set_contact_gap(here%wanted, gap%y, gap%h, gap%inv2r, status)
        do k = 1, size(target_names)
            case%wanted%target = k
            call solve_contact(here%wanted, case, figures, status)
            code = max(code, status%code)
            call add(here%wanted%steps%estimate)
            call add(figures%normal%pmax)
            call add(figures%tangential%fx)
        end do

    contains

        subroutine add(value)
            real(wp), intent(in) :: value

            bits = ieor(ishftc(bits, 7), transfer(value, bits))
        end subroutine add
    end subroutine solve
end module contacts
"""

COUNTING = """
program counting
    use contacts
    implicit none
    integer, parameter :: numbers(5) = [0, 5, 15, 31, 101]
    type(workspaces_t) :: here
    type(gap_t) :: gap
    integer(int64) :: bits
    integer(c_long) :: before, after
    integer :: kind, i, code

    call reserve(here)
    do kind = 1, kinds
        call make(kind, gap)
        do i = 1, size(numbers)
            ! The linear algebra library sets itself up in its first call.
            if (kind == 1 .and. i == 1) call solve(here, gap, 101, bits, code)
            before = allocations()
            call solve(here, gap, numbers(i), bits, code)
            after = allocations()
            print '(a, 4(1x, i0), 1x, z16.16)', 'solved', kind, numbers(i), code, &
                after - before, bits
        end do
    end do
    before = allocations()
    call make(1, gap)
    print '(a, 1x, i0)', 'counts', allocations() - before
end program counting
"""

THREADS = """
program threads
    use contacts
    implicit none
    integer, parameter :: numbers(5) = [0, 5, 15, 31, 101], rounds = 1
    type(gap_t) :: gaps(kinds)
    integer(int64) :: bits(size(numbers), size(gaps), rounds)
    integer :: codes(size(numbers), size(gaps), rounds), i, kind, round

    do kind = 1, size(gaps)
        call make(kind, gaps(kind))
    end do
    !$omp parallel num_threads(2)
    call work()
    !$omp end parallel
    do round = 1, rounds
        do kind = 1, size(gaps)
            do i = 1, size(numbers)
                print '(a, 4(1x, i0), 1x, z16.16)', 'solved', kind, numbers(i), &
                    codes(i, kind, round), 0, bits(i, kind, round)
            end do
        end do
    end do

contains

    !> Backwards, so that what a workspace did before differs from the other program's.
    subroutine work()
        ! Not a private variable of the team: its components would have no first values.
        type(workspaces_t) :: here
        integer :: job, i, kind, round

        call reserve(here)
        !$omp do schedule(dynamic, 1)
        do job = size(bits) - 1, 0, -1
            i = 1 + modulo(job, size(numbers))
            kind = 1 + modulo(job/size(numbers), size(gaps))
            round = 1 + job/(size(numbers)*size(gaps))
            call solve(here, gaps(kind), numbers(i), bits(i, kind, round), codes(i, kind, round))
        end do
        !$omp end do
    end subroutine work
end program threads
"""


class Solver(HostTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for name, text in (("counter.c", COUNTER), ("contacts.f90", MODULE),
                           ("counting.f90", COUNTING), ("threads.f90", THREADS)):
            cls.write(name, text)
        cls.shell("gcc -O1 -c counter.c")
        flags = "-O1 -frecursive -fopenmp $(pkg-config --cflags faststrip)"
        cls.shell(f"gfortran {flags} -c contacts.f90")
        for name in ("counting", "threads"):
            cls.shell(f"gfortran {flags} {name}.f90 contacts.o counter.o -o {name}"
                      " $(pkg-config --libs faststrip)")
        cls.counting = cls.solved("counting")

    @classmethod
    def solved(cls, name, library_threads=1):
        """Rows of kind, strips, status code, allocations; and the bits by kind and strips."""
        text = cls.shell(f"./{name}", OPENBLAS_NUM_THREADS=str(library_threads))
        rows, bits = [], {}
        for line in text.splitlines():
            if not line.startswith("solved"):
                continue
            *numbers, word = line.split()[1:]
            kind, strips, code, allocations = map(int, numbers)
            rows.append((kind, strips, code, allocations))
            bits.setdefault((kind, strips), set()).add(word)
        return text, rows, bits

    def test_nothing_is_allocated_after_the_workspace_is_reserved(self):
        text, rows, _ = self.counting
        self.assertEqual(len(rows), 25)
        codes = {code for _, _, code, _ in rows}
        self.assertLessEqual({0, 8}, codes)
        for kind, strips, code, allocations in rows:
            with self.subTest(kind=kind, strips=strips):
                self.assertLess(code, 100)
                self.assertEqual(allocations, 0)
        # The counter does count: a gap is three arrays.
        self.assertGreaterEqual(int(re.search(r"^counts (\d+)$", text, re.MULTILINE)[1]), 3)

    def test_the_same_bits_in_every_process_and_thread(self):
        _, _, first = self.counting
        self.assertEqual({len(words) for words in first.values()}, {1})
        self.assertGreater(len(set().union(*first.values())), 15)
        _, _, shared = self.solved("counting", library_threads=2)
        self.assertEqual(shared, first)
        _, rows, threads = self.solved("threads")
        self.assertEqual(len(rows), 25)
        self.assertEqual(threads, first)
