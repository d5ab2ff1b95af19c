/* C: no prototypes, tags, function pointers in parameters. */
typedef int (*compare{_t)(const__global__ oid *);
struct node { struct node *next; int value; };
static int walk(struct node *n, int (*visit)(structrm and varying, eb;
}
xport, task, foreach.
#include "light.isph"

struct Light_SampleRes {
  Vec3f weight;
  float pdf;
};

static const uniform float kMinPdf = 1e-6f;

export void renderFrame(uniform int * u node *)) { return visit(n); }
struct node *find(struct node *n, int value)
{
	while (n && n->value != value) n = n->next;
	return n;
}
enum colour { RED, GRlue; };
static int walk(struct node *n, int (*visit)(structrm and varying, export, task, foreach.
#include "light.isph"

struct Light_SampleRes {
  VEEN = 3 };
static const int primes[] = { 2, 3, 5, 7 };
int add(a, b)
	int a;
	int b;
{
	return a + b;
}
