// The order of keys that the formats of files have: a new member goes where its format has it. The
// same as src/serve/edit/key_order.cpp.

const words = (text: string) => text.split(' ');

const kObject = words('id kind at angle size radius height mass colour x');
const kSupervisor = words('template period_ms in out events help x');
const kSlot = words('type unit help default range scale words x');
const kOutcome = words('event out help x');

/** "*": any key; "[]": any index. */
const orders: Record<string, readonly (readonly [string, readonly string[]])[]> = {
  plan: [
    ['', words('format name help toolboxes configuration start actors layout x')],
    ['configuration *', words('type initial unit help access x')],
    ['start', words('actor supervisors x')],
    ['start supervisors *', kSupervisor],
    ['actors *', words('template plan in out states supervisors help x')],
    ['actors * supervisors *', kSupervisor],
  ],
  world: [
    ['', words('format name help seed size open ground objects robots timeline fleet x')],
    ['objects []', kObject],
    ['robots []', words('name type at angle grid spacing node port script project paint x')],
    ['timeline []', words('t do id object robot at angle button on x')],
    ['fleet', words('latency jitter loss twice x')],
    ['timeline [] object', kObject],
  ],
  project: [
    ['', words('format name help plan scripts world toolboxes target start x')],
    ['start', words('plan set x')],
  ],
  toolbox: [
    ['', words('format name help project templates x')],
    ['templates *', words('kind help icon node in out start stop stopped states events x')],
    ['templates * in *', kSlot],
    ['templates * out *', kSlot],
    ['templates * states *', kOutcome],
    ['templates * events *', kOutcome],
  ],
};

/** Of the members of the object there; empty: the format says nothing of it. */
export function keyOrder(language: string, path: readonly string[]): readonly string[] {
  const found = orders[language]?.find(([pattern]) => {
    const steps = pattern === '' ? [] : pattern.split(' ');
    return (
      steps.length === path.length &&
      steps.every((step, index) => step === path[index] || step === '*')
    );
  });
  return found?.[1] ?? [];
}
