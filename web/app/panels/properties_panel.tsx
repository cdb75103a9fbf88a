import { useEffect } from 'react';
import { useStudio } from '../hooks';
import { Quiet } from '../parts/blank';
import { text } from '../text';
import { deskOf, useDesk } from '../views/world/desk';
import { ThingForm } from '../views/world/thing_form';
import '../look/world.css';

/** What is chosen, to be changed exactly. */
export default function PropertiesPanel() {
  const studio = useStudio();
  const { shown } = useDesk(studio);
  useEffect(() => deskOf(studio).addForm(), [studio]);
  if (!shown) return <Quiet>{text.empty.properties}</Quiet>;
  return (
    <div className="scroll">
      <ThingForm world={shown} />
    </div>
  );
}
