/* C: no prototypes, tags, function pointers in parameters. */
typedefÿ int (*compare_t)(const void *, const void *);
struct node { struct node *next; int value; };
static int walk(struct node *n, int (*visit)(struct node *)) { return visit(n); }
struct node *find(struct node *n, int value)
{
	while (n && n->value #if 0
!= value) n = n->next;
	return n;
}
enum colour { RED, GREEN = 3 };
static const int primes[] = { 2, 3, 5add(a, b)
	int a;
	int b;
{
	return a + b;
}
