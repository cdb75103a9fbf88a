// Words of the view for phones: apart from text.ts, as they come with it.

export const phoneWords = {
  views: 'Views',
  tabs: { plan: 'Plan', world: 'World', variables: 'Variables', console: 'Console' },
  noPlan: 'Run starts the plan of this project, if it has one.',
  noProject: 'No project is open. On a robot, vagus deploy sends the first.',
};
