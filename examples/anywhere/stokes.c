/* Stokes flow through the unit square by the C interface of Tunica: an ordinary C program, which
 * knows nothing of Trilinos.
 *
 *   stokes 64
 *   mpirun -n 2 stokes 64
 *
 * n x n squares, velocities and pressure bilinear, stabilised after Brezzi and Pitkaranta. Of each
 * node the pressure comes first, as in many programs: 3 * node + {p, u, v}.
 *
 *   [mu A  B'] [u]   [f]     A = integral of grad u . grad v,   B = - that of q div u
 *   [B    -C ] [p] = [0]     C = h^2 / (12 mu) A
 *
 * f drives along x; the fluid sticks to three sides and leaves through x = 1. Twice the viscosity
 * makes the velocities half of what they were and leaves the pressures: that is the check.
 *
 * Exit status: 0 all is as expected, 1 not.
 */
#include <math.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <tunica/tunica.h>

enum { p, u, v, unknowns };

/* Rows of the nodes from first on. */
typedef struct {
  int n;
  long long first, nodes, entries;
  long long *offsets, *columns;
  double *values, *b;
} Rows;

/* Integral along a line over one cell of the functions of two ends, differentiated or not. */
static double line(double h, int a, int b, int da, int db) {
  if (da && db) return (a == b ? 1.0 : -1.0) / h;
  if (da) return a ? 0.5 : -0.5;
  if (db) return b ? 0.5 : -0.5;
  return a == b ? h / 3.0 : h / 6.0;
}

/* The same over a square, of corners a and b; d: 0 none, 1 by x, 2 by y. */
static double square(double h, int a, int b, int da, int db) {
  return line(h, a & 1, b & 1, da == 1, db == 1) *
         line(h, a >> 1, b >> 1, da == 2, db == 2);
}

static double entry(double h, double mu, int a, int i, int b, int j) {
  const double laplace = square(h, a, b, 1, 1) + square(h, a, b, 2, 2);
  if (i == p && j == p) return -h * h / (12.0 * mu) * laplace;
  if (i == p) return -square(h, a, b, 0, j);
  if (j == p) return -square(h, a, b, i, 0);
  return i == j ? mu * laplace : 0.0;
}

/* Prescribed values stand in rows of their own, whose columns stay: Tunica takes them out. */
static int is_fixed(const Rows* rows, long long node) {
  const long long m = rows->n + 1, x = node % m, y = node / m;
  return x == 0 || y == 0 || y == rows->n;
}

static void add(Rows* rows, long long column, double value) {
  rows->columns[rows->entries] = column;
  rows->values[rows->entries++] = value;
}

/* Row by row and square by square: entries that occur twice add up. */
static void assemble(Rows* rows, double mu) {
  const int n = rows->n;
  const double h = 1.0 / n;
  rows->entries = 0;
  rows->offsets[0] = 0;
  for (long long k = 0; k < rows->nodes; ++k) {
    const long long node = rows->first + k;
    const int x = (int)(node % (n + 1)), y = (int)(node / (n + 1));
    for (int i = 0; i < unknowns; ++i) {
      const long long row = unknowns * k + i;
      rows->b[row] = 0.0;
      for (int a = 0; a < 4; ++a) { /* the node is corner a of this square */
        const int left = x - (a & 1), low = y - (a >> 1);
        if (left < 0 || low < 0 || left == n || low == n) continue;
        if (i != p && is_fixed(rows, node)) continue;
        if (i == u) rows->b[row] += h * h / 4.0;
        for (int c = 0; c < 4; ++c) {
          const long long other = left + (c & 1) + (n + 1LL) * (low + (c >> 1));
          for (int j = 0; j < unknowns; ++j)
            add(rows, unknowns * other + j, entry(h, mu, a, i, c, j));
        }
      }
      if (i != p && is_fixed(rows, node)) add(rows, unknowns * node + i, 1.0);
      rows->offsets[row + 1] = rows->entries;
    }
  }
}

static Rows rows_of(int n, int rank, int ranks) {
  Rows rows = {n, 0, 0, 0, NULL, NULL, NULL, NULL};
  const long long all = (n + 1LL) * (n + 1);
  rows.first = all * rank / ranks;
  rows.nodes = all * (rank + 1) / ranks - rows.first;
  rows.offsets = malloc((unknowns * rows.nodes + 1) * sizeof *rows.offsets);
  rows.columns = malloc(rows.nodes * unknowns * 4 * 4 * unknowns * sizeof *rows.columns);
  rows.values = malloc(rows.nodes * unknowns * 4 * 4 * unknowns * sizeof *rows.values);
  rows.b = malloc(unknowns * rows.nodes * sizeof *rows.b);
  return rows;
}

static void release(Rows* rows) {
  free(rows->offsets);
  free(rows->columns);
  free(rows->values);
  free(rows->b);
}

/* Largest difference of two solutions, of the velocities by factor. */
static double difference(const Rows* rows, const double* x, const double* y, double factor) {
  double mine = 0.0, largest = 0.0;
  for (long long k = 0; k < unknowns * rows->nodes; ++k)
    mine = fmax(mine, fabs(x[k] - (k % unknowns == p ? 1.0 : factor) * y[k]));
  MPI_Allreduce(&mine, &largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return largest;
}

static int solve(tunica_solver* solver, const Rows* rows, double* x, int rank) {
  const int status = tunica_solve(solver, rows->b, x);
  const tunica_report* report = tunica_query(solver);
  if (rank == 0) {
    if (status != TUNICA_SOLVED) printf("status %d: %s\n", status, report->message);
    printf("%lld unknowns, %s: %d iterations, residual %.1e\n", report->unknowns, report->setting,
           report->iterations, report->residual);
    printf("set-up %.3f s, refresh %.3f s, solve %.3f s\n", report->setup_seconds,
           report->refresh_seconds, report->solve_seconds);
  }
  return status == TUNICA_SOLVED;
}

static int run(int n, int rank, int ranks) {
  const int communicator = MPI_Comm_c2f(MPI_COMM_WORLD);
  Rows rows = rows_of(n, rank, ranks);
  const long long count = unknowns * rows.nodes;
  double *x = malloc(count * sizeof *x), *y = malloc(count * sizeof *y);
  assemble(&rows, 1.0);
  tunica_solver* solver =
      tunica_create(count, rows.offsets, rows.columns, rows.values, NULL, &communicator);
  if (rank == 0) printf("%s", tunica_query(solver)->notes);
  int is_good = solve(solver, &rows, x, rank);
  assemble(&rows, 2.0);
  is_good &= tunica_refresh(solver, rows.values) == TUNICA_SOLVED;
  is_good &= tunica_query(solver)->is_refresh_numeric;
  is_good &= solve(solver, &rows, y, rank);
  const double apart = difference(&rows, x, y, 2.0);
  if (rank == 0) printf("twice the viscosity, half the velocity: %.1e apart\n", apart);
  tunica_destroy(solver);
  release(&rows);
  free(x);
  free(y);
  return is_good && apart < 1e-6;
}

int main(int argc, char** argv) {
  int rank, ranks;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const int is_good = run(argc > 1 ? atoi(argv[1]) : 32, rank, ranks);
  MPI_Finalize();
  return is_good ? 0 : 1;
}
