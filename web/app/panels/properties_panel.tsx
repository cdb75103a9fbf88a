import { useEffect, useState } from 'react';
import { useStudio } from '../hooks';
import { Quiet } from '../parts/blank';
import { text } from '../text';
import { PlanForm } from '../views/plan/form/plan_form';
import { planDeskOf, usePlanDesk } from '../views/plan/plan_desk';
import { deskOf, useDesk } from '../views/world/desk';
import { ThingForm } from '../views/world/thing_form';
import '../look/world.css';
import '../look/palette.css';

/** What is chosen, in the plan or the world that was used last, to be changed exactly. */
export default function PropertiesPanel() {
  const studio = useStudio();
  const world = useDesk(studio).shown;
  const plan = usePlanDesk(studio).shown;
  const [last, used] = useState<'plan' | 'world'>('plan');
  useEffect(() => deskOf(studio).addForm(), [studio]);
  useEffect(() => {
    const ends = [
      planDeskOf(studio).used.on(() => used('plan')),
      deskOf(studio).used.on(() => used('world')),
    ];
    return () => ends.forEach((end) => end());
  }, [studio]);
  if (!plan && !world) return <Quiet>{text.empty.properties}</Quiet>;
  return (
    <div className="scroll">
      {plan && (last === 'plan' || !world) ? (
        <PlanForm plan={plan} />
      ) : world ? (
        <ThingForm world={world} />
      ) : null}
    </div>
  );
}
